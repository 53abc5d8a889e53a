//! Calls of the C interface, as the bytes say: a model is built, solved, and asked.

use super::bytes::Bytes;
use super::given::{self, Arrays};
use super::promises::{check_numbers, check_status, last_message};
use periodyn::capi::beam::*;
use periodyn::capi::bushing::*;
use periodyn::capi::controller::pdn_model_add_controller;
use periodyn::capi::files::*;
use periodyn::capi::force::*;
use periodyn::capi::id::*;
use periodyn::capi::joint::*;
use periodyn::capi::label::*;
use periodyn::capi::linear_solver::PDN_LINEAR_AUTOMATIC;
use periodyn::capi::load::*;
use periodyn::capi::march::*;
use periodyn::capi::model::*;
use periodyn::capi::modes::*;
use periodyn::capi::parameter::*;
use periodyn::capi::periodic::*;
use periodyn::capi::quantity::*;
use periodyn::capi::relation::*;
use periodyn::capi::solution::*;
use periodyn::capi::statics::*;
use periodyn::capi::summary::*;
use periodyn::capi::table::*;
use periodyn::capi::user_force::{PDN_TANGENTS_DIFFERENCED, pdn_model_add_coordinate_law};
use std::ffi::CString;
use std::mem::MaybeUninit;
use std::path::Path;
use std::ptr::{null, null_mut};

/// Calls of one run.
const MOST_CALLS: usize = 48;
/// Calls of progress after which a solve is cancelled.
const PATIENCE: u32 = 400;

/// A call, whose status is checked.
macro_rules! call {
    ($function:ident($($argument:expr),* $(,)?)) => {{
        // SAFETY: handles are alive, arrays as long as told, pointers NULL or to places.
        let status = unsafe { $function($($argument),*) };
        check_status(stringify!($function), status);
        status
    }};
}

/// A struct with its defaults.
macro_rules! defaults {
    ($type:ty, $init:ident) => {{
        let mut value = MaybeUninit::<$type>::zeroed();
        // SAFETY: plain numbers and pointers, of the size told.
        unsafe {
            $init(value.as_mut_ptr(), size_of::<$type>());
            value.assume_init()
        }
    }};
}

mod shells;

/// What there is to ask.
struct Session<'a, 'b> {
    bytes: &'a mut Bytes<'b>,
    model: *mut pdn_model,
    solutions: Vec<*mut pdn_solution>,
    path: CString,
}

/// Runs the calls that the bytes say; files go to `path`.
pub fn run(data: &[u8], path: &Path) {
    let mut bytes = Bytes(data);
    let path = CString::new(path.to_string_lossy().as_bytes()).unwrap_or_default();
    let mut session = Session {
        bytes: &mut bytes,
        model: null_mut(),
        solutions: Vec::new(),
        path,
    };
    call!(pdn_model_new(&mut session.model));
    for _ in 0..MOST_CALLS {
        if session.bytes.is_empty() {
            break;
        }
        given::plan_failure(session.bytes);
        session.step();
    }
    session.end();
}

impl Session<'_, '_> {
    fn step(&mut self) {
        match self.bytes.below(16) {
            0..=1 => self.body(),
            2..=3 => self.joint(),
            4 => self.beam(),
            5..=6 => self.force(),
            7 => self.load(),
            8 => self.parameter(),
            9 => self.file(),
            10..=11 => self.solve(),
            12 => self.look(),
            13 if self.bytes.below(3) == 0 => self.controller(),
            13 => self.shell(),
            _ => self.ask(),
        }
    }

    /// Numbers of nodes, joints, elements and forces.
    fn counts(&self) -> [usize; 4] {
        let mut counts = [0; 4];
        let [nodes, joints, elements, forces] = &mut counts;
        call!(pdn_model_node_count(self.model, nodes));
        call!(pdn_model_joint_count(self.model, joints));
        call!(pdn_model_element_count(self.model, elements));
        call!(pdn_model_force_count(self.model, forces));
        counts.map(|count: i32| count as usize)
    }

    fn body(&mut self) {
        let [nodes, ..] = self.counts();
        let (mass, centre) = (self.bytes.positive(), self.bytes.numbers::<3>());
        let moment = self.bytes.positives::<3>();
        let mut inertia = [0.0; 9];
        (inertia[0], inertia[4], inertia[8]) = (moment[0], moment[1], moment[2]);
        let mut node = 0;
        if self.bytes.rarely(5) {
            let node = self.bytes.constant(PDN_FIRST_NODE, nodes);
            let (centre, inertia) = (centre.as_ptr(), inertia.as_ptr());
            call!(pdn_model_add_mass(
                self.model,
                node,
                mass,
                centre,
                inertia,
                null_mut()
            ));
        } else {
            let (centre, inertia) = (centre.as_ptr(), inertia.as_ptr());
            let added = call!(pdn_model_add_rigid_body(
                self.model, mass, centre, inertia, &mut node
            ));
            let [after, ..] = self.counts();
            assert_eq!(after - nodes, usize::from(added == 0), "a body, or nothing");
        }
    }

    fn joint(&mut self) {
        let [nodes, joints, ..] = self.counts();
        let first = match self.bytes.rarely(3) {
            true => self.bytes.constant(PDN_FIRST_NODE, nodes),
            false => -1,
        };
        let (second, kind) = (
            self.bytes.constant(PDN_FIRST_NODE, nodes),
            self.bytes.below(9),
        );
        let (point, axis) = (self.bytes.numbers::<3>(), self.bytes.axis());
        let other = self.bytes.axis();
        let (p, a, b) = (point.as_ptr(), axis.as_ptr(), other.as_ptr());
        let (model, mut id) = (self.model, 0);
        let out = &mut id;
        let added = match kind {
            0 => call!(pdn_model_add_rigid_joint(model, first, second, p, out)),
            1..=3 => call!(pdn_model_add_revolute(model, first, second, p, a, out)),
            4 => call!(pdn_model_add_prismatic(model, first, second, p, a, out)),
            5 => call!(pdn_model_add_cylindrical(model, first, second, p, a, out)),
            6 => call!(pdn_model_add_spherical(model, first, second, p, out)),
            7 => call!(pdn_model_add_universal(model, first, second, p, a, b, out)),
            _ => {
                let pitch = self.bytes.number();
                call!(pdn_model_add_screw(model, first, second, p, a, pitch, out))
            }
        };
        assert_eq!(
            self.counts()[1] - joints,
            usize::from(added == 0),
            "a joint, or nothing"
        );
        if self.bytes.below(2) == 0 {
            let (joint, coordinate) = (
                self.bytes.constant(PDN_FIRST_JOINT, joints + 1),
                self.coordinate(),
            );
            let mut arrays = Arrays::default();
            let signal = given::signal(self.bytes, &mut arrays);
            call!(pdn_model_prescribe(
                model,
                joint,
                coordinate,
                &signal,
                null_mut()
            ));
        }
    }

    fn beam(&mut self) {
        let [_, _, elements, _] = self.counts();
        if elements > 3 {
            return;
        }
        let (start, end, axis) = (
            self.bytes.numbers::<3>(),
            self.bytes.numbers::<3>(),
            self.bytes.axis(),
        );
        let section = given::section(self.bytes);
        let (count, degree) = (self.bytes.below(3), self.bytes.below(5));
        let mut beam = MaybeUninit::zeroed();
        call!(pdn_model_add_straight_beam(
            self.model,
            start.as_ptr(),
            end.as_ptr(),
            axis.as_ptr(),
            &section,
            count,
            degree,
            beam.as_mut_ptr(),
        ));
    }

    fn force(&mut self) {
        let [nodes, joints, ..] = self.counts();
        let (joint, coordinate) = (
            self.bytes.constant(PDN_FIRST_JOINT, joints),
            self.coordinate(),
        );
        let (model, mut id) = (self.model, 0);
        let out = &mut id;
        let [a, b, rest] = self.bytes.numbers();
        let more = self.bytes.numbers::<3>();
        let times = self.bytes.positives::<2>();
        let count = self.bytes.below(3);
        match self.bytes.below(8) {
            0..=1 => {
                call!(pdn_model_add_spring_damper(
                    model,
                    joint,
                    coordinate,
                    a.abs(),
                    b,
                    rest,
                    out
                ))
            }
            2 => call!(pdn_model_add_nonlinear_spring_damper(
                model,
                joint,
                coordinate,
                more.as_ptr(),
                count,
                times.as_ptr(),
                count,
                rest,
                out,
            )),
            3 => call!(pdn_model_add_viscoelastic(
                model,
                joint,
                coordinate,
                a,
                rest,
                more.as_ptr(),
                times.as_ptr(),
                count,
                out,
            )),
            4 => {
                let mut arrays = Arrays::default();
                let signal = given::signal(self.bytes, &mut arrays);
                call!(pdn_model_add_actuator(
                    model, joint, coordinate, &signal, out
                ))
            }
            5 => self.bushing(nodes),
            6 => self.relation(joints),
            _ if self.bytes.below(2) == 0 => {
                let second = self.bytes.constant(PDN_FIRST_NODE, nodes);
                let matrix: [f64; 36] =
                    std::array::from_fn(|i| if i % 7 == 0 { b.abs() } else { 0.0 });
                call!(pdn_model_add_viscous_damper(
                    model,
                    -1,
                    second,
                    null(),
                    matrix.as_ptr(),
                    out
                ))
            }
            _ => call!(pdn_model_add_coordinate_law(
                model,
                joint,
                coordinate,
                self.bytes.constant(PDN_TANGENTS_DIFFERENCED, 2),
                Some(given::law),
                null_mut(),
                None,
                out,
            )),
        };
    }

    fn bushing(&mut self, nodes: usize) -> i32 {
        let first = match self.bytes.rarely(3) {
            true => self.bytes.constant(PDN_FIRST_NODE, nodes),
            false => -1,
        };
        let second = self.bytes.constant(PDN_FIRST_NODE, nodes);
        let frames = [self.frame(), self.frame()];
        let [stiffness, damping] = [(); 2].map(|()| {
            let mut matrix = [0.0; 36];
            for entry in matrix.iter_mut().take(18) {
                *entry = self.bytes.number();
            }
            matrix
        });
        let (angles, mut id) = (self.bytes.constant(PDN_ANGLES_ROTATION_VECTOR, 2), 0);
        call!(pdn_model_add_bushing(
            self.model,
            first,
            second,
            &frames[0],
            &frames[1],
            stiffness.as_ptr(),
            damping.as_ptr(),
            angles,
            &mut id,
        ))
    }

    /// Of up to two coordinates that it reads, and acts on, and of up to two states.
    fn controller(&mut self) {
        let [_, joints, ..] = self.counts();
        let ids = [(); 4].map(|()| self.bytes.constant(PDN_FIRST_JOINT, joints));
        let coordinates = [(); 4].map(|()| self.coordinate());
        let counts = [(); 3].map(|()| self.bytes.below(3));
        let (initial, sizes) = (self.bytes.numbers::<2>(), self.bytes.positives::<2>());
        let mut id = 0;
        call!(pdn_model_add_controller(
            self.model,
            ids.as_ptr(),
            coordinates.as_ptr(),
            counts[0],
            ids[2..].as_ptr(),
            coordinates[2..].as_ptr(),
            counts[1],
            initial.as_ptr(),
            sizes.as_ptr(),
            counts[2],
            self.bytes.constant(PDN_TANGENTS_DIFFERENCED, 2),
            Some(given::controller),
            null_mut(),
            None,
            &mut id,
        ));
    }

    /// Where axes are turned by a quarter or not.
    fn coordinate(&mut self) -> i32 {
        self.bytes.constant(PDN_DISPLACEMENT, 6)
    }

    fn frame(&mut self) -> pdn_frame {
        let rotation = match self.bytes.rarely(2) {
            true => [0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
            false => [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        };
        pdn_frame {
            position: self.bytes.numbers::<3>(),
            rotation,
        }
    }

    fn relation(&mut self, joints: usize) -> i32 {
        let ids = [(); 2].map(|()| self.bytes.constant(PDN_FIRST_JOINT, joints));
        let coordinates = [(); 2].map(|()| self.coordinate());
        let coefficients = self.bytes.numbers::<2>();
        let mut arrays = Arrays::default();
        let signal = given::signal(self.bytes, &mut arrays);
        let signal = match self.bytes.rarely(3) {
            true => &raw const signal,
            false => null(),
        };
        let (count, mut id) = (self.bytes.below(3), 0);
        call!(pdn_model_add_relation(
            self.model,
            ids.as_ptr(),
            coordinates.as_ptr(),
            coefficients.as_ptr(),
            count,
            signal,
            &mut id,
        ));
        let kind = self.bytes.constant(PDN_OBJECT_NODE, 11);
        let label = [b'a' + self.bytes.byte() % 4, 0];
        let label = label.as_ptr().cast();
        let object = self.bytes.constant(PDN_FIRST_JOINT, joints);
        call!(pdn_model_set_label(self.model, object, label));
        call!(pdn_model_find_label(self.model, kind, label, &mut id))
    }

    fn load(&mut self) {
        let [nodes, ..] = self.counts();
        if self.bytes.below(3) == 0 {
            let gravity = self.bytes.numbers::<3>();
            call!(pdn_model_set_gravity(self.model, gravity.as_ptr()));
            return;
        }
        let node = self.bytes.constant(PDN_FIRST_NODE, nodes);
        let frame = self.bytes.constant(PDN_FRAME_SPACE, 2);
        let component = self.bytes.constant(PDN_FORCE_1, 6);
        let mut arrays = Arrays::default();
        let signal = given::signal(self.bytes, &mut arrays);
        let offset = self.bytes.numbers::<3>();
        let offset = match self.bytes.rarely(3) {
            true => null(),
            false => offset.as_ptr(),
        };
        let load = null_mut();
        match self.bytes.below(3) {
            0 => call!(pdn_model_add_load(
                self.model, node, frame, component, &signal, load
            )),
            1 => call!(pdn_model_add_load_at_point(
                self.model, node, offset, frame, component, &signal, load
            )),
            _ => {
                let (first, count) = (PDN_FIRST_BEAM_ELEMENT, self.bytes.below(3) as i32);
                let fraction = self.bytes.number();
                call!(pdn_model_add_load_on_beam(
                    self.model, first, count, fraction, offset, frame, component, &signal, load
                ))
            }
        };
    }

    fn parameter(&mut self) {
        let (value, scale) = (self.bytes.number(), self.bytes.positive());
        let name = CString::new(format!("p{}", self.bytes.byte())).unwrap_or_default();
        let (model, mut id) = (self.model, 0);
        if call!(pdn_model_add_parameter(
            model,
            name.as_ptr(),
            value,
            scale,
            &mut id
        )) != 0
        {
            return;
        }
        for _ in 0..self.bytes.below(3) {
            let number = self.bytes.constant(PDN_NUMBER_STIFFNESS, 8);
            let first = match number {
                PDN_NUMBER_INERTIA => PDN_FIRST_INERTIA,
                PDN_NUMBER_BEAM_STIFFNESS..=PDN_NUMBER_BEAM_DAMPING => PDN_FIRST_BEAM_ELEMENT,
                PDN_NUMBER_MASS_DAMPING => 0,
                _ => PDN_FIRST_FORCE,
            };
            let moved = self.bytes.constant(first, 3);
            let (power, factor) = (self.bytes.index(3), self.bytes.number());
            call!(pdn_model_move_number(
                model, id, number, moved, power, factor
            ));
        }
        let value = self.bytes.number();
        call!(pdn_model_set_parameter(model, id, value));
    }

    /// What a model or a solution is saved as can be loaded.
    fn file(&mut self) {
        let path = self.path.as_ptr();
        let mut model = null_mut();
        assert_eq!(call!(pdn_model_save(self.model, path)), 0);
        let loaded = call!(pdn_model_load(path, &mut model));
        assert_eq!(
            loaded,
            0,
            "a model that was taken is one that its file gives back: {}",
            last_message()
        );
        // SAFETY: made just now.
        unsafe { pdn_model_free(model) };
        if let Some(&solution) = self.solutions.last() {
            let mut loaded = null_mut();
            assert_eq!(call!(pdn_solution_save(solution, path)), 0);
            let status = call!(pdn_solution_load(path, &mut loaded));
            assert_eq!(
                status,
                0,
                "a solution is what its file gives back: {}",
                last_message()
            );
            self.solutions.push(loaded);
        }
    }

    fn look(&mut self) {
        let mut summary = defaults!(pdn_summary, pdn_summary_init);
        call!(pdn_model_summary(self.model, &mut summary));
        let (mut mass, mut centre) = (0.0, [0.0; 3]);
        let status = call!(pdn_model_mass(self.model, &mut mass, centre.as_mut_ptr()));
        check_numbers(
            "pdn_model_mass",
            status,
            &[mass, centre[0], centre[1], centre[2]],
        );
        let mut text = [0; 100];
        // SAFETY: as long as told.
        unsafe { pdn_model_describe(self.model, text.as_mut_ptr(), text.len()) };
    }

    fn solve(&mut self) {
        given::be_patient(PATIENCE);
        let mut out = null_mut();
        let period = self.bytes.positive();
        let initial = match (self.bytes.rarely(4), self.solutions.last()) {
            (true, Some(&solution)) => solution,
            _ => null_mut(),
        };
        let status = match self.bytes.below(8) {
            0..=3 => {
                let mut options = defaults!(pdn_periodic_options, pdn_periodic_options_init);
                options.grid_points = [0, 1, 3, 5, 7, 9, 4, 15][self.bytes.below(8)];
                options.largest_grid_points = 31;
                options.iteration_limit = 1 + self.bytes.below(12);
                options.linear_solver =
                    PDN_LINEAR_AUTOMATIC + [0, 0, 0, 1, 2, 3, 4, 5][self.bytes.below(8)];
                options.oversampling = [1, 1, 1, 2, 0][self.bytes.below(5)];
                options.start = PDN_START_AUTOMATIC + [0, 0, 0, 1, 2, 3, 4, 5][self.bytes.below(8)];
                options.memory_limit = [0, 0, 0, 1 << 20][self.bytes.below(4)];
                options.initial = initial;
                options.progress = Some(given::progress);
                options.progress_interval = 0.0;
                call!(pdn_solve_periodic(self.model, period, &options, &mut out))
            }
            4 => {
                let mut options = defaults!(pdn_static_options, pdn_static_options_init);
                options.time = self.bytes.number();
                options.load_steps = self.bytes.below(4);
                options.initial = initial;
                options.progress = Some(given::progress);
                call!(pdn_solve_static(self.model, &options, &mut out))
            }
            5..=6 => {
                let mut options = defaults!(pdn_march_options, pdn_march_options_init);
                options.step = self.bytes.positive();
                options.duration = options.step * self.bytes.below(40) as f64;
                options.period = [0.0, period, options.step][self.bytes.below(3)];
                options.spectral_radius = [0.5, 0.0, 1.0, 2.0][self.bytes.below(4)];
                options.stored_periods = self.bytes.below(2);
                options.initial = initial;
                options.progress = Some(given::progress);
                call!(pdn_solve_march(self.model, &options, &mut out))
            }
            _ => {
                self.modes();
                return;
            }
        };
        if status == 0 {
            self.solutions.push(out);
        }
    }

    fn modes(&mut self) {
        let mut equilibrium = defaults!(pdn_static_options, pdn_static_options_init);
        equilibrium.progress = Some(given::progress);
        let mut options = defaults!(pdn_modes_options, pdn_modes_options_init);
        options.equilibrium = &equilibrium;
        options.count = 1 + self.bytes.below(4);
        let mut modes = null_mut();
        if call!(pdn_solve_modes(self.model, &options, &mut modes)) != 0 {
            return;
        }
        let mut count = 0;
        call!(pdn_modes_count(modes, &mut count, null_mut()));
        for number in 0..count {
            let mut mode = defaults!(pdn_mode, pdn_mode_init);
            let status = call!(pdn_modes_get(modes, number, &mut mode));
            let numbers = [
                mode.eigenvalue_real,
                mode.frequency,
                mode.modal_mass,
                mode.residual,
            ];
            check_numbers("pdn_modes_get", status, &numbers);
        }
        if count > 0 {
            let amplitude = self.bytes.number();
            let mut motion = null_mut();
            if call!(pdn_modes_motion(modes, 0, amplitude, &mut motion)) == 0 {
                self.solutions.push(motion);
            }
        }
        // SAFETY: made above.
        unsafe { pdn_modes_free(modes) };
    }

    fn ask(&mut self) {
        let Some(&solution) = self.solutions.last() else {
            return;
        };
        let [nodes, joints, elements, forces] = self.counts();
        let mut quantity = defaults!(pdn_quantity, pdn_quantity_init);
        let objects = [
            (PDN_NODE_POSITION, PDN_FIRST_NODE, nodes),
            (PDN_JOINT_COORDINATE, PDN_FIRST_JOINT, joints),
            (PDN_BEAM_STRAIN, PDN_FIRST_BEAM_ELEMENT, elements),
            (PDN_FORCE_EFFORT, PDN_FIRST_FORCE, forces),
            (PDN_SHELL_STRAIN, PDN_FIRST_SHELL_ELEMENT, 4),
            (PDN_RELATION_EFFORT, PDN_FIRST_RELATION, 2),
        ];
        let (kind, first, count) = objects[self.bytes.below(6)];
        quantity.kind = self.bytes.constant(kind, 7);
        quantity.object = self.bytes.constant(first, count);
        if self.bytes.below(2) == 0 {
            quantity.component = match self.bytes.below(2) {
                0 => self.coordinate(),
                _ => self.bytes.index(6),
            };
        }
        quantity.frame = PDN_FRAME_SPACE + self.bytes.below(5) as i32;
        quantity.station = f64::from(self.bytes.byte()) / 128.0 - 1.0;
        let times: [f64; 3] = self.bytes.numbers();
        let (t, q) = (times.as_ptr(), &raw const quantity);
        // SAFETY: initialised.
        let count = unsafe { pdn_quantity_components(q) }.max(0) as usize;
        let mut values = vec![0.0; 40];
        let harmonics = self.bytes.below(4);
        let (many, out) = (count.max(1) * 3, values.as_mut_ptr());
        match self.bytes.below(6) {
            0..=1 => {
                let status = call!(pdn_solution_sample(solution, q, t, 3, out));
                check_numbers("pdn_solution_sample", status, &values[..many.min(40)]);
            }
            2 => {
                let (mean, rate) = (null_mut(), null_mut());
                let status = call!(pdn_solution_harmonics(
                    solution,
                    q,
                    harmonics,
                    mean,
                    rate,
                    out,
                    null_mut(),
                ));
                check_numbers("pdn_solution_harmonics", status, &values);
            }
            3 => {
                let mut others = [[0.0; 12]; 3];
                let [a, b, c] = others.each_mut().map(|place| place.as_mut_ptr());
                let status = call!(pdn_solution_extremes(solution, q, out, a, b, c));
                check_numbers("pdn_solution_extremes", status, &values);
                check_numbers("pdn_solution_extremes", status, others.as_flattened());
            }
            4 => {
                let mut found = defaults!(pdn_diagnostics, pdn_diagnostics_init);
                call!(pdn_solution_diagnostics(solution, &mut found));
                let harmonics = found.grid_points.div_ceil(2);
                let mut amplitudes = vec![0.0; harmonics];
                let (length, place) = (amplitudes.len(), amplitudes.as_mut_ptr());
                let status = call!(pdn_solution_decay(solution, place, length));
                check_numbers("pdn_solution_decay", status, &amplitudes);
                assert!(!found.error_estimate.is_nan(), "an estimate, or none");
            }
            _ => {
                let mut table = null_mut();
                if call!(pdn_table_new(t, 3, &mut table)) == 0 {
                    call!(pdn_table_add_quantity(table, solution, q, null()));
                    call!(pdn_table_write_csv(table, self.path.as_ptr()));
                    // SAFETY: made just now.
                    unsafe { pdn_table_free(table) };
                }
            }
        }
    }

    fn end(&mut self) {
        for solution in self.solutions.drain(..) {
            // SAFETY: each was made once.
            unsafe { pdn_solution_free(solution) };
        }
        // SAFETY: the last use.
        unsafe { pdn_model_free(self.model) };
    }
}
