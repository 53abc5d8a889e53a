//! Shells: of a grid or of quadrilaterals, with loads, prestress, rigid edges and surface forces;
//! forces along beams like these.

use super::{Arrays, Session, check_status, given};
use periodyn::capi::id::{PDN_FIRST_BEAM_ELEMENT, PDN_FIRST_NODE, PDN_FIRST_SHELL_ELEMENT};
use periodyn::capi::load::{PDN_FORCE_1, PDN_FRAME_SPACE};
use periodyn::capi::rigid_edge::*;
use periodyn::capi::shell::*;
use periodyn::capi::surface_force::{pdn_model_add_line_force, pdn_model_add_surface_force};
use periodyn::capi::user_force::PDN_TANGENTS_DIFFERENCED;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

/// Most shell elements of a model.
const MOST_ELEMENTS: i32 = 6;

impl Session<'_, '_> {
    /// A shell, or something on those that are there.
    pub(super) fn shell(&mut self) {
        let mut elements = 0;
        call!(pdn_model_shell_element_count(self.model, &mut elements));
        match self.bytes.below(9) {
            0..=2 if elements < MOST_ELEMENTS => self.grid(),
            3 if elements < MOST_ELEMENTS => self.quadrilaterals(),
            4 => self.surface_force(elements as usize),
            5 => self.rigid_joints(),
            6 => self.prestress(elements as usize),
            8 => self.line_force(),
            _ => self.shell_load(elements as usize),
        }
    }

    /// Of a plate that bends, mostly.
    fn shell_section(&mut self) -> pdn_shell_section {
        let [modulus, thickness, density] = self.bytes.positives();
        let ratio = self.bytes.number() / 16.0;
        let mut section = defaults!(pdn_shell_section, pdn_shell_section_init);
        let drilling = self.bytes.positive();
        call!(pdn_shell_section_set_isotropic(
            &mut section,
            0.1 * thickness,
            1e3 * modulus,
            ratio,
            density,
            drilling,
            0.1,
        ));
        if self.bytes.rarely(8) {
            let at = self.bytes.below(144);
            section.stiffness[at] = self.bytes.number();
        }
        section
    }

    /// One to four elements, flat or bent, an edge of which may be rigid.
    fn grid(&mut self) {
        let [elements_u, elements_v] = [(); 2].map(|()| 1 + self.bytes.below(2));
        let [degree_u, degree_v] = [(); 2].map(|()| 1 + self.bytes.below(3));
        let (nodes_u, nodes_v) = (elements_u * degree_u + 1, elements_v * degree_v + 1);
        let corner = self.bytes.numbers::<3>();
        let [length, width] = self.bytes.positives();
        let (bend, odd) = (self.bytes.number() / 8.0, self.bytes.rarely(8));
        let mut points = Vec::new();
        for i in 0..nodes_u {
            for j in 0..nodes_v {
                let [u, v] = [
                    i as f64 / (nodes_u - 1) as f64,
                    j as f64 / (nodes_v - 1) as f64,
                ];
                points.extend([
                    corner[0] + length * u,
                    corner[1] + width * v,
                    corner[2] + bend * u * u,
                ]);
            }
        }
        if odd {
            let at = self.bytes.below(points.len());
            points[at] = self.bytes.number();
        }
        let section = self.shell_section();
        let mut shell = MaybeUninit::<pdn_shell>::zeroed();
        let added = call!(pdn_model_add_shell_grid(
            self.model,
            points.as_ptr(),
            points.len() / 3,
            elements_u,
            elements_v,
            degree_u,
            degree_v,
            i32::from(self.bytes.rarely(3)),
            &section,
            null(),
            shell.as_mut_ptr(),
        ));
        if added != 0 || self.bytes.rarely(3) {
            return;
        }
        let [nodes, ..] = self.counts();
        let body = match self.bytes.rarely(3) {
            true => -1,
            false => self.bytes.constant(PDN_FIRST_NODE, nodes),
        };
        let edge = self.bytes.constant(PDN_SHELL_EDGE_START_ETA, 4);
        let (mut first, mut count) = (0, 0);
        call!(pdn_model_add_rigid_edge(
            self.model,
            body,
            shell.as_ptr(),
            edge,
            &mut first,
            &mut count,
        ));
    }

    /// Two cells with a common side, or what bytes make of it.
    fn quadrilaterals(&mut self) {
        let mut points = [
            [0.0, 0.0],
            [1.0, 0.0],
            [1.0, 1.0],
            [0.0, 1.0],
            [2.0, 0.0],
            [2.0, 1.0],
        ]
        .map(|[x, y]| [x, y, 0.0]);
        let mut cells = [0, 1, 2, 3, 1, 4, 5, 2];
        let size = self.bytes.positive();
        points.iter_mut().flatten().for_each(|x| *x *= size);
        if self.bytes.rarely(3) {
            points[self.bytes.below(6)] = self.bytes.numbers();
        }
        if self.bytes.rarely(4) {
            cells[self.bytes.below(8)] = self.bytes.index(6);
        }
        let (section, degree) = (self.shell_section(), 1 + self.bytes.below(3));
        let mut first = 0;
        call!(pdn_model_add_shell_quadrilaterals(
            self.model,
            points.as_flattened().as_ptr(),
            points.len(),
            cells.as_ptr(),
            cells.len(),
            4,
            degree,
            &section,
            null(),
            &mut first,
        ));
    }

    fn surface_force(&mut self, elements: usize) {
        let mut first = 0;
        call!(pdn_model_add_surface_force(
            self.model,
            self.bytes.constant(PDN_FIRST_SHELL_ELEMENT, elements),
            1,
            self.bytes.constant(PDN_SHELL_EDGE_START_ETA, 5),
            self.bytes.constant(PDN_FRAME_SPACE, 2),
            PDN_TANGENTS_DIFFERENCED,
            Some(given::surface_force),
            null_mut(),
            None,
            &mut first,
        ));
    }

    fn line_force(&mut self) {
        let [_, _, elements, _] = self.counts();
        let mut first = 0;
        let axis_2 = self.bytes.numbers::<3>();
        call!(pdn_model_add_line_force(
            self.model,
            self.bytes.constant(PDN_FIRST_BEAM_ELEMENT, elements),
            1,
            self.bytes.constant(PDN_FRAME_SPACE, 3),
            axis_2.as_ptr(),
            PDN_TANGENTS_DIFFERENCED,
            Some(given::surface_force),
            null_mut(),
            None,
            &mut first,
        ));
    }

    fn rigid_joints(&mut self) {
        let [nodes, ..] = self.counts();
        let body = match self.bytes.rarely(3) {
            true => -1,
            false => self.bytes.constant(PDN_FIRST_NODE, nodes),
        };
        let ids = [(); 3].map(|()| self.bytes.constant(PDN_FIRST_NODE, nodes));
        let (count, mut first, mut joints) = (self.bytes.below(4), 0, 0);
        call!(pdn_model_add_rigid_joints(
            self.model,
            body,
            ids.as_ptr(),
            count,
            &mut first,
            &mut joints,
        ));
    }

    fn prestress(&mut self, elements: usize) {
        let (first, resultants) = (
            self.bytes.constant(PDN_FIRST_SHELL_ELEMENT, elements),
            self.bytes.numbers::<12>(),
        );
        let resultants = resultants.as_ptr();
        call!(pdn_model_set_shell_prestress(
            self.model, first, 1, resultants
        ));
    }

    fn shell_load(&mut self, elements: usize) {
        let (first, place) = (
            self.bytes.constant(PDN_FIRST_SHELL_ELEMENT, elements),
            self.bytes.constant(PDN_SHELL_EDGE_START_ETA, 5),
        );
        let frame = self.bytes.constant(PDN_FRAME_SPACE, 2);
        let component = self.bytes.constant(PDN_FORCE_1, 6);
        let mut arrays = Arrays::default();
        let signal = given::signal(self.bytes, &mut arrays);
        call!(pdn_model_add_shell_load(
            self.model,
            first,
            1,
            place,
            frame,
            component,
            &signal,
            null_mut()
        ));
    }
}
