//! What is connected to what.

use super::{ElementRole, Placed, System};

/// Representative of each element of a partition, found by following links.
pub(super) struct Partition(Vec<usize>);

impl Partition {
    pub fn new(count: usize) -> Self {
        Partition((0..count).collect())
    }

    pub fn find(&mut self, mut i: usize) -> usize {
        while self.0[i] != i {
            self.0[i] = self.0[self.0[i]];
            i = self.0[i];
        }
        i
    }

    pub fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        // The least one represents all.
        self.0[a.max(b)] = a.min(b);
    }

    pub fn representatives(mut self) -> Vec<usize> {
        (0..self.0.len()).map(|i| self.find(i)).collect()
    }
}

/// The nodes, and the ground behind them, as elements of those that `count` connect them.
fn connected(system: &System, counts: impl Fn(&Placed) -> bool) -> Partition {
    let ground = system.nodes();
    let mut connected = Partition::new(ground + 1);
    for placed in system.elements().iter().filter(|placed| counts(placed)) {
        let nodes = placed.element.nodes();
        for pair in nodes.windows(2) {
            connected.join(pair[0], pair[1]);
        }
        if let (ElementRole::Joint(_) | ElementRole::Force(_), [node]) = (placed.role, nodes) {
            connected.join(*node, ground);
        }
    }
    connected
}

/// For each node the number of its part, if no element of those that `count` is connected to the
/// ground or, where nothing is, to the first node: parts count from 1 then, and none stands for the
/// first part.
pub(super) fn parts(system: &System, counts: impl Fn(&Placed) -> bool) -> Vec<Option<usize>> {
    let ground = system.nodes();
    let representatives = connected(system, counts).representatives();
    let main = match representatives[ground] {
        alone if alone == ground => representatives[0],
        main => main,
    };
    let mut others: Vec<usize> = Vec::new();
    representatives[..ground]
        .iter()
        .map(|&r| {
            if r == main {
                return None;
            }
            let place = others.iter().position(|&o| o == r).unwrap_or_else(|| {
                others.push(r);
                others.len() - 1
            });
            Some(place + 1)
        })
        .collect()
}

impl System {
    /// Whether no joint or force connects some of the nodes to the ground, be it through others: at
    /// another place these move as they do here.
    pub(crate) fn has_floating_nodes(&self) -> bool {
        use ElementRole::{Force, Inertia, Load, MassDamping};
        let ground = self.nodes();
        let mut connected = connected(self, |placed| {
            !matches!(placed.role, Inertia | Load | MassDamping)
        });
        // Some forces depend on where in space their nodes are.
        let forces = self.elements().iter();
        for placed in forces.filter(|placed| matches!(placed.role, Force(_))) {
            for &node in placed.element.nodes() {
                connected.join(node, ground);
            }
        }
        let representatives = connected.representatives();
        representatives
            .iter()
            .any(|&r| r != representatives[ground])
    }
}
