//! Solutions saved in files, and loaded from them.
//!
//! A file is a header and a body. The header has 24 bytes: a signature, the version of the format,
//! a CRC-32 of all that follows it and of the version, and the length of the body; integers are
//! little-endian. The body is the [`Content`] in MessagePack, with the names of all fields.
//!
//! A field that is added later gets a default, so that older files can be read; one that changes
//! its meaning, or goes, takes a new version:
//!
//! 1. Beams with the motions of their nodes, and the inertia of each written out; functions of the
//!    user with what belongs to them. It can still be read.
//! 2. Definitions alone.

use super::diagnostics::Diagnostics;
use super::force::ForceRecord;
use super::solution::Solution;
use super::write::{refused, write_file};
use crate::collocation::GridState;
use crate::elements::NodeState;
use crate::error::{Error, ErrorKind, Result, require_finite};
use crate::fourier::{SpectralFilter, TimeGrid};
use crate::model::Model;
use crate::solve::{
    Attempt, GridTried, IterativeRecord, MarchRecord, NewtonReport, PeriodicSolve, Timings,
};
use crate::system::{Regime, Standstill, System, Transient};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// A byte beyond ASCII and line ends, so that a transfer as text is noticed.
const SIGNATURE: [u8; 8] = *b"\x93PDN\r\n\x1a\n";
/// The version that is written, and the latest that can be read.
const VERSION: u32 = 2;
const HEADER: usize = 24;

/// All that a solution is made of.
#[derive(Serialize, Deserialize)]
struct Content<'a> {
    model: Cow<'a, Model>,
    period: f64,
    grid_points: usize,
    standstill: Option<Standstill>,
    state: Cow<'a, GridState>,
    node_states: Cow<'a, [NodeState]>,
    report: Cow<'a, NewtonReport>,
    guess_iterations: usize,
    guess_time: Duration,
    timings: Timings,
    #[serde(default)]
    total_time: Duration,
    #[serde(default)]
    total_iterations: usize,
    prescribed_start: Cow<'a, [f64]>,
    diagnostics: Cow<'a, Diagnostics>,
    forces: Cow<'a, [Result<ForceRecord>]>,
    #[serde(default)]
    grids: Cow<'a, [GridTried]>,
    #[serde(default)]
    coarse_start: Option<GridTried>,
    #[serde(default)]
    filter: Option<SpectralFilter>,
    #[serde(default)]
    iterative: Option<Cow<'a, IterativeRecord>>,
    /// Of a trajectory.
    #[serde(default)]
    march: Option<Cow<'a, MarchRecord>>,
    #[serde(default)]
    transient: Option<Transient>,
    #[serde(default)]
    attempts: Cow<'a, [Attempt]>,
}

impl Solution {
    /// Saves the solution with its model, whether it has converged or not.
    ///
    /// Functions of the user, in signals and forces, cannot be saved: see [`Solution::load`].
    ///
    /// # Errors
    /// [`ErrorKind::Io`]; a file that was there stays as it was.
    pub fn save(&self, path: &Path) -> Result<()> {
        let regime = *self.solve.system.regime();
        let content = Content {
            model: Cow::Borrowed(&self.model),
            period: self.solve.grid.period(),
            grid_points: self.solve.grid.points(),
            standstill: regime.standstill().copied(),
            state: Cow::Borrowed(&self.solve.state),
            node_states: Cow::Borrowed(&self.solve.node_states),
            report: Cow::Borrowed(&self.solve.report),
            guess_iterations: self.solve.guess_iterations,
            guess_time: self.solve.guess_time,
            timings: self.solve.timings,
            total_time: self.solve.total_time,
            total_iterations: self.solve.total_iterations,
            prescribed_start: Cow::Borrowed(&self.prescribed_start),
            diagnostics: Cow::Borrowed(self.diagnostics()),
            forces: Cow::Borrowed(&self.forces),
            grids: Cow::Borrowed(&self.solve.grids),
            coarse_start: self.solve.coarse_start,
            attempts: Cow::Borrowed(&self.solve.attempts),
            filter: self.filter,
            iterative: self.solve.iterative.as_ref().map(Cow::Borrowed),
            march: self.solve.march.as_ref().map(Cow::Borrowed),
            transient: match regime {
                Regime::March(transient) => Some(transient),
                _ => None,
            },
        };
        let body = rmp_serde::to_vec_named(&content)
            .map_err(|e| refused("write", path, &io::Error::other(e)))?;
        let header = header(&body);
        write_file(path, |file| {
            file.write_all(&header)?;
            file.write_all(&body)
        })
    }

    /// Loads a solution. It gives what the saved one gave, to the last bit, and a solve may start
    /// from it.
    ///
    /// If its model had functions of the user, its quantities are there all the same; but a solve
    /// of the loaded model fails with [`ErrorKind::Callback`], since the functions are not.
    ///
    /// # Errors
    /// [`ErrorKind::Io`]; [`ErrorKind::Format`] if the file is no solution, damaged, or of a newer
    /// version.
    pub fn load(path: &Path) -> Result<Self> {
        let mut file = File::open(path).map_err(|e| refused("read", path, &e))?;
        let file_of = |what: String| {
            let message = format!("path: \"{}\" {what}", path.display());
            Error::new(ErrorKind::Format, message)
        };
        let mut header = Vec::new();
        let head = Read::by_ref(&mut file)
            .take(HEADER as u64)
            .read_to_end(&mut header);
        head.map_err(|e| refused("read", path, &e))?;
        let (checksum, length) = read_header(&header).map_err(file_of)?;
        // As long as the file is, whatever its header says.
        let mut body = Vec::new();
        let rest = file.take(length.saturating_add(1)).read_to_end(&mut body);
        rest.map_err(|e| refused("read", path, &e))?;
        let found = body.len() as u64;
        if found < length {
            let what = format!("is cut off: {found} of {length} bytes after its header are there");
            return Err(file_of(what));
        }
        if found > length {
            return Err(file_of("is damaged: it goes on after its end".into()));
        }
        if checksum != checksum_of(&header, &body) {
            return Err(file_of("is damaged: its checksum is wrong".into()));
        }
        let content: Content = rmp_serde::from_slice(&body)
            .map_err(|e| file_of(format!("is no solution that can be read: {e}")))?;
        content
            .into_solution()
            .map_err(|e| file_of(format!("is no valid solution: {e}")))
    }
}

fn header(body: &[u8]) -> Vec<u8> {
    let mut header = SIGNATURE.to_vec();
    header.extend(VERSION.to_le_bytes());
    header.extend([0; 4]);
    header.extend((body.len() as u64).to_le_bytes());
    let checksum = checksum_of(&header, body);
    header[12..16].copy_from_slice(&checksum.to_le_bytes());
    header
}

/// CRC-32 of the version, the length and the body.
fn checksum_of(header: &[u8], body: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&header[8..12]);
    hasher.update(&header[16..HEADER]);
    hasher.update(body);
    hasher.finalize()
}

/// Checksum and length of the body, or what is wrong with the file.
fn read_header(header: &[u8]) -> std::result::Result<(u32, u64), String> {
    let shared = header.len().min(SIGNATURE.len());
    if header.is_empty() || header[..shared] != SIGNATURE[..shared] {
        return Err("is not a saved solution".into());
    }
    let (Some(version), Some(checksum), Some(length)) = (
        bytes_at(header, 8),
        bytes_at(header, 12),
        bytes_at(header, 16),
    ) else {
        return Err("is cut off: it ends in its header".into());
    };
    match u32::from_le_bytes(version) {
        1..=VERSION => Ok((u32::from_le_bytes(checksum), u64::from_le_bytes(length))),
        newer if newer > VERSION => Err(format!(
            "is of version {newer} of the format; this library reads up to {VERSION}: use a newer \
             one"
        )),
        unknown => Err(format!(
            "names version {unknown} of the format, which never was"
        )),
    }
}

fn bytes_at<const N: usize>(bytes: &[u8], start: usize) -> Option<[u8; N]> {
    bytes.get(start..start + N)?.try_into().ok()
}

fn require(holds: bool, what: &str) -> Result<()> {
    if holds {
        return Ok(());
    }
    let message = format!("{what}: not as many as its model and grid need");
    Err(Error::new(ErrorKind::Format, message))
}

impl Content<'_> {
    /// The solution, if everything in it fits together.
    fn into_solution(self) -> Result<Solution> {
        let model = self.model.into_owned().checked()?;
        let grid = TimeGrid::new(self.grid_points, self.period)?;
        let regime = match (self.standstill, self.transient) {
            (None, None) => Regime::Periodic(self.period),
            (_, Some(transient)) => {
                transient.validate()?;
                Regime::March(transient)
            }
            (Some(standstill), None) => {
                require_finite("time", &[standstill.time])?;
                require_finite("angular velocity", standstill.angular_velocity.as_slice())?;
                require_finite("axis", standstill.axis_point.as_slice())?;
                Regime::Standstill(standstill)
            }
        };
        let system = Arc::new(System::of_known_solution(&model, regime)?);
        let march = self.march.map(Cow::into_owned);
        require(march.is_some() == self.transient.is_some(), "steps")?;
        let points = match &march {
            Some(record) => {
                let ascending = record.times.windows(2).all(|pair| pair[0] < pair[1]);
                let known = record.times.iter().all(|t| t.is_finite());
                require(ascending && known && !record.times.is_empty(), "times")?;
                require(grid.points() == 1, "grid points")?;
                record.times.len()
            }
            None => grid.points(),
        };
        let times = |count: usize| count.checked_mul(points);
        let mut state = self.state.into_owned();
        let states = Some(self.node_states.len());
        require(state.points() == points, "grid points")?;
        require(
            Some(state.motions.len()) == times(system.nodes()),
            "motions",
        )?;
        require(states == times(system.nodes()), "states of nodes")?;
        let multipliers = Some(state.multipliers.len());
        require(multipliers == times(system.multipliers()), "multipliers")?;
        // Older files have those only that forces act on.
        state.complete_tracked(&system, system.acted_on());
        let coordinates = Some(state.coordinates.len());
        require(coordinates == times(system.tracked()), "coordinates")?;
        let starts = self.prescribed_start.len();
        require(starts == model.prescribed.len(), "prescribed coordinates")?;
        let diagnostics = self.diagnostics.into_owned();
        let harmonics = diagnostics.harmonics.len();
        let expected = if march.is_some() {
            0
        } else {
            grid.harmonics() + 1
        };
        require(harmonics == expected, "harmonics")?;
        require(self.forces.len() == model.forces.len(), "forces")?;
        for record in self.forces.iter().flatten() {
            require(record.fits(points), "values of forces")?;
        }
        Ok(Solution {
            solve: PeriodicSolve {
                system,
                grid,
                state,
                node_states: self.node_states.into_owned(),
                report: self.report.into_owned(),
                guess_iterations: self.guess_iterations,
                guess_time: self.guess_time,
                timings: self.timings,
                total_time: self.total_time,
                total_iterations: self.total_iterations,
                grids: self.grids.into_owned(),
                coarse_start: self.coarse_start,
                attempts: self.attempts.into_owned(),
                iterative: self.iterative.map(Cow::into_owned),
                threads: 1,
                assessment: None,
                mesh_error: diagnostics.mesh_error,
                march,
            },
            model,
            prescribed_start: self.prescribed_start.into_owned(),
            diagnostics,
            forces: self.forces.into_owned(),
            filter: self.filter,
        })
    }
}
