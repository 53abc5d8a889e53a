//! Loads on each edge of a shell element, by the reactions of nodes that are all held.

mod common;

use common::models::shells::{mesh, rubber_plate};
use common::*;
use nalgebra::Vector3;
use periodyn::elements::{LoadFrame, ShellLoadPlace};
use periodyn::model::*;
use periodyn::output::{JointQuantity, ResolvedIn, Solution};
use periodyn::solve::*;

#[test]
fn loads_on_edges_are_those_of_their_lengths_and_axes() {
    let size = [2.0, 3.0];
    // Along the edge, across it, along the normal.
    let load = [1.0, 2.0, 5.0];
    for edge in 0..4 {
        let (mut model, _) = rubber_plate(size, 0.3, &mesh([1, 1], [3, 2]));
        let nodes = model.node_count();
        assert_eq!(nodes, 6);
        let clamps: Vec<usize> = (0..nodes).map(|node| clamp(&mut model, node)).collect();
        let component = |i: usize| load.get(i).map(|&x| Signal::constant(x).unwrap());
        let definition = ShellLoadDefinition {
            first_element: 0,
            elements: 1,
            place: ShellLoadPlace::Edge(edge),
            frame: LoadFrame::Follower,
            components: std::array::from_fn(component),
        };
        model.add_shell_load(definition).unwrap();
        let solution =
            Solution::solve_static(&model, &StaticOptions::default(), &mut |_, _| true).unwrap();
        assert_eq!(solution.outcome(), Outcome::Converged);
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for (node, clamp) in clamps.into_iter().enumerate() {
            let reaction = JointQuantity::Reaction(ResolvedIn::Space);
            let reaction = solution.joint(clamp, reaction, &[0.0]).unwrap();
            let on_node = -Vector3::from_column_slice(&reaction[..3]);
            let own = -Vector3::from_column_slice(&reaction[3..]);
            force += on_node;
            moment += model.node(node).unwrap().position.cross(&on_node) + own;
        }
        let [length, width] = size;
        let (exact, middle) = match edge {
            0 | 2 => (
                Vector3::new(load[0], load[1], load[2]) * length,
                Vector3::new(0.5 * length, if edge == 0 { 0.0 } else { width }, 0.0),
            ),
            _ => (
                Vector3::new(-load[1], load[0], load[2]) * width,
                Vector3::new(if edge == 1 { length } else { 0.0 }, 0.5 * width, 0.0),
            ),
        };
        assert!(
            (force - exact).amax() < 1e-12 * 20.0,
            "edge {edge}: {force} {exact}"
        );
        let error = (moment - middle.cross(&exact)).amax();
        assert!(error < 1e-12 * 50.0, "edge {edge}: {moment}");
    }
}
