//! The joints that turn, where harmonics are spread over ranks: their system is small, and all
//! ranks solve it alike.

use super::block_lu::BlockLanes;
use super::constraints::Class;
use super::harmonic_band::Spectra;
use super::interface::{Bounds, Interface, LEFT_OUT};
use super::lanes::{ComplexLanes, LANES, Lanes};
use super::layout::Layout;
use super::spread::{COMPLEX, OwnPart, Spread};
use super::transform::Transform;
use crate::collocation::Item;
use crate::error::Result;
use crate::ranks::Ranks;
use nalgebra::Complex;
use std::ops::Range;

/// The system of the joints may be as large as it is: there is nothing else to try.
const UNBOUNDED: Bounds = Bounds {
    most_work: f64::INFINITY,
    any_band: true,
    left_out: LEFT_OUT,
};

/// What closes the joints that turn.
pub(super) struct Closure {
    points: usize,
    pub interface: Interface,
    stiffness: Spectra,
    /// Unknowns of a harmonic that are not eliminated.
    kept: Vec<usize>,
    /// Where each rank's exact multipliers are: in its part if it is this one, and in the vector of
    /// all elements with own unknowns.
    rows: Vec<Vec<(usize, usize)>>,
    own_rows: Vec<(usize, usize)>,
    /// Such a vector.
    x: Vec<f64>,
    /// Forces on what is kept, motions of it, and forces by these.
    series: [Vec<Vec<f64>>; 3],
}

impl Closure {
    /// Makes and factors the system of the joints that turn; none if that cannot be done. By all
    /// ranks.
    ///
    /// # Errors
    /// If numbers cannot be told, or memory runs out.
    pub fn new(
        spread: &Spread,
        (own, classes): (&OwnPart, &[Class]),
        layout: &Layout,
        factors: &[BlockLanes<ComplexLanes>],
        harmonics: &Range<usize>,
    ) -> Result<Option<Self>> {
        let points = spread.equations.grid().points();
        let kept: Vec<usize> = layout.kept().collect();
        let places = places_of_kept(layout, own, classes);
        let places: Option<Vec<_>> = kept.iter().map(|unknown| places[*unknown]).collect();
        let interface =
            places.and_then(|places| Interface::new(&own.equations, classes, &places, UNBOUNDED));
        let Some(mut interface) = interface else {
            return Ok(None);
        };
        let of_kept = (layout, factors, harmonics.len());
        let stiffness = gathered_stiffness(&**spread.ranks, of_kept, &kept)?;
        let mut transform = Transform::new(points);
        let multiply = &mut |motions: &[Vec<f64>], forces: &mut [Vec<f64>]| {
            multiply(&stiffness, &mut transform, motions, forces);
        };
        let factored = interface.factor(&stiffness, multiply, spread.equations.workers());
        if !spread.ranks.agreed(factored)? {
            return Ok(None);
        }
        let rows = |rank: usize| -> Vec<(usize, usize)> {
            let of_rank = own.elements.iter().zip(classes).enumerate();
            let of_rank = of_rank.filter(|(_, (index, class))| {
                let placed = &spread.whole.elements()[**index];
                matches!(class, Class::Exact(_)) && spread.partition.of_element(placed) == rank
            });
            let rows = of_rank.flat_map(|(local, _)| {
                let placed = &own.equations.system().elements()[local];
                let range = own.equations.layout().element_at(placed, 0);
                let stride = range.len();
                range.map(move |first| (first, stride))
            });
            rows.collect()
        };
        let here = own.elements.iter().zip(classes).filter(|(index, class)| {
            let placed = &spread.whole.elements()[**index];
            let owner = spread.partition.of_element(placed);
            matches!(class, Class::Exact(_)) && owner == spread.ranks.rank()
        });
        let own_rows = here.flat_map(|(&index, _)| {
            let count = spread.whole.elements()[index].element.own_unknowns();
            (0..count).map(move |row| spread.local_place((Item::Element(index), row)))
        });
        let series = || vec![vec![0.0; points]; kept.len()];
        Ok(Some(Closure {
            points,
            own_rows: own_rows.collect(),
            rows: (0..spread.ranks.count()).map(rows).collect(),
            x: vec![0.0; own.equations.size()],
            series: [series(), series(), series()],
            interface,
            stiffness,
            kept,
        }))
    }

    /// Solves for the motions that are kept, and the multipliers of joints that turn.
    pub fn solve(
        &mut self,
        ranks: &dyn Ranks,
        harmonics: &Range<usize>,
        lanes: &mut [Vec<ComplexLanes>],
        transform: &mut Transform,
        x: &mut [f64],
    ) -> Result<()> {
        let points = self.points;
        let Closure {
            interface,
            stiffness,
            kept,
            rows,
            own_rows,
            x: all,
            series: [forces, motions, products],
            ..
        } = self;
        let mut own = Vec::new();
        for h in 0..harmonics.len() {
            for &unknown in &*kept {
                let value = lanes[h / LANES][unknown].get(h % LANES);
                own.extend([value.re, value.im]);
            }
        }
        let (spectra, _) = ranks.gathered_any(&own)?;
        let scale = 1.0 / points as f64;
        for (place, force) in forces.iter_mut().enumerate() {
            let harmonics = spectra.chunks_exact((COMPLEX * kept.len()).max(1));
            let spectrum = transform.synthesis.spectrum.iter_mut();
            for (to, values) in spectrum.zip(harmonics) {
                let value = &values[COMPLEX * place..][..COMPLEX];
                *to = Complex::new(value[0], value[1]) * scale;
            }
            force.copy_from_slice(transform.backward());
        }
        own.clear();
        for &(first, stride) in &*own_rows {
            own.extend(x[first..].iter().step_by(stride).take(points));
        }
        let counts: Vec<usize> = rows.iter().map(|rows| rows.len() * points).collect();
        let given = ranks.gathered(&own, &counts)?;
        for (&(first, stride), given) in rows.iter().flatten().zip(given.chunks(points)) {
            let places = all[first..].iter_mut().step_by(stride);
            places.zip(given).for_each(|(x, value)| *x = *value);
        }
        interface.determined(all, motions);
        multiply(stiffness, transform, motions, products);
        subtract_from(forces, products);
        interface.add_free(products, motions);
        multiply(stiffness, transform, motions, products);
        subtract_from(forces, products);
        interface.write_multipliers(products, all);
        for (&unknown, motion) in kept.iter().zip(&*motions) {
            transform.analysis.read(motion.iter().copied());
            for (h, j) in harmonics.clone().enumerate() {
                let value = transform.analysis.spectrum[j];
                lanes[h / LANES][unknown].set(h % LANES, value);
            }
        }
        let here = &rows[ranks.rank()];
        for (&(to, stride), &(from, step)) in own_rows.iter().zip(here) {
            let values = all[from..].iter().step_by(step).take(points);
            let places = x[to..].iter_mut().step_by(stride);
            places.zip(values).for_each(|(x, value)| *x = *value);
        }
        Ok(())
    }
}

/// Dynamic stiffness of what is kept, in all harmonics.
fn gathered_stiffness(
    ranks: &dyn Ranks,
    (layout, factors, count): (&Layout, &[BlockLanes<ComplexLanes>], usize),
    kept: &[usize],
) -> Result<Spectra> {
    let structure = &layout.structure;
    let number = |unknown: usize| kept.partition_point(|&k| k < unknown);
    let mut places = Vec::new();
    for &(row, column, _) in structure.kept() {
        for i in 0..structure.size(row) {
            for j in 0..structure.size(column) {
                let entry = structure.entry((row, column), (i, j));
                let (a, b) = (structure.first(row) + i, structure.first(column) + j);
                places.push((entry, number(a), number(b)));
            }
        }
    }
    let mut own = Vec::with_capacity(COMPLEX * places.len() * count);
    for h in 0..count {
        for (entry, ..) in &places {
            let value = factors[h / LANES].get(*entry).get(h % LANES);
            own.extend([value.re, value.im]);
        }
    }
    let (all, _) = ranks.gathered_any(&own)?;
    let mut stiffness = vec![vec![Vec::new(); kept.len()]; kept.len()];
    // A rank's harmonics follow those of the one before.
    let harmonics = all.chunks_exact((COMPLEX * places.len()).max(1));
    for harmonic in harmonics {
        for ((_, a, b), value) in places.iter().zip(harmonic.chunks_exact(COMPLEX)) {
            stiffness[*a][*b].push(Complex::new(value[0], value[1]));
        }
    }
    Ok(stiffness)
}

/// `y = x − y`, series by series.
fn subtract_from(x: &[Vec<f64>], y: &mut [Vec<f64>]) {
    for (y, x) in y.iter_mut().zip(x) {
        y.iter_mut().zip(x).for_each(|(y, x)| *y = x - *y);
    }
}

/// Forces by motions over the grid.
fn multiply(
    stiffness: &Spectra,
    transform: &mut Transform,
    motions: &[Vec<f64>],
    forces: &mut [Vec<f64>],
) {
    let scale = 1.0 / motions.first().map_or(1, Vec::len) as f64;
    let spectra: Vec<Vec<Complex<f64>>> = motions
        .iter()
        .map(|motion| {
            transform.analysis.read(motion.iter().copied());
            transform.analysis.spectrum.clone()
        })
        .collect();
    for (row, force) in stiffness.iter().zip(forces) {
        let sum = &mut transform.synthesis.spectrum;
        sum.fill(Complex::default());
        for (entries, spectrum) in row.iter().zip(&spectra) {
            // Empty where nothing is coupled.
            for ((sum, entry), value) in sum.iter_mut().zip(entries).zip(spectrum) {
                *sum += entry * value * scale;
            }
        }
        force.copy_from_slice(transform.backward());
    }
}

/// Of each unknown of a harmonic: its place in vectors of the elements with own unknowns, if it is
/// there.
fn places_of_kept(
    layout: &Layout,
    own: &OwnPart,
    classes: &[Class],
) -> Vec<Option<(usize, usize)>> {
    let mut places = vec![None; layout.structure.unknowns()];
    let (equations, unknowns) = (&own.equations, own.equations.layout());
    let mut put = |(row, first): (usize, usize), range: Range<usize>| {
        let (at, stride) = (layout.structure.first(row) + first, range.len());
        for (i, place) in range.enumerate() {
            places[at + i] = Some((place, stride));
        }
    };
    for (local, &node) in own.nodes.iter().enumerate() {
        put(layout.node_at[node], unknowns.motion(local, 0));
    }
    for (local, class) in classes.iter().enumerate() {
        if matches!(class, Class::Averaged(_)) {
            let placed = &equations.system().elements()[local];
            put(
                layout.own_at[own.elements[local]],
                unknowns.element_at(placed, 0),
            );
        }
    }
    places
}
