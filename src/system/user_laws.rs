//! Laws of the user, as elements call them.

use super::build::Builder;
use super::scales::coordinate_scales;
use crate::elements::{
    Controller, ControllerInput, ControllerLaw, CoordinateLaw, CoordinateState, Effort, ForcePlace,
    LoadFrame, NodeForceInput, NodeForceLaw, SurfaceForce, SurfaceForceInput, SurfaceForceLaw,
    UserForce,
};
use crate::error::{Error, Result};
use crate::model::{ControllerDefinition, UserFunction};
use std::f64::consts::TAU;
use std::sync::Arc;

impl Builder<'_> {
    /// A function of the user, or what stands for it where it does not matter.
    fn function<F: Clone>(&mut self, function: &UserFunction<F>, zero: F) -> Result<F> {
        if self.known && function.is_absent() {
            self.lacks_functions = true;
            return Ok(zero);
        }
        function.get().cloned()
    }

    /// A user's law on a joint coordinate, that is told the time.
    pub(super) fn coordinate_law(
        &mut self,
        law: &UserFunction<CoordinateLaw>,
        cycles: usize,
    ) -> Result<CoordinateLaw> {
        let zero = CoordinateLaw {
            function: Arc::new(|_| Ok(Effort::default())),
            gives_derivatives: true,
        };
        let mut law = self.function(law, zero)?;
        if cycles > 0 {
            let (unit, function) = (self.phase_unit()? * cycles as f64, law.function);
            law.function = Arc::new(move |state| {
                let time = state.time * unit;
                function(&CoordinateState { time, ..*state })
            });
        }
        Ok(law)
    }

    /// A user's law on nodes, that is told the time.
    pub(super) fn node_law(
        &mut self,
        law: &UserFunction<NodeForceLaw>,
        cycles: usize,
    ) -> Result<NodeForceLaw> {
        let zero = NodeForceLaw {
            function: Arc::new(|_, _| Ok(())),
            gives_tangents: true,
            frame: LoadFrame::Space,
        };
        let mut law = self.function(law, zero)?;
        if cycles > 0 {
            let (unit, function) = (self.phase_unit()? * cycles as f64, law.function);
            law.function = Arc::new(move |state, out| {
                let time = state.time * unit;
                function(&NodeForceInput { time, ..*state }, out)
            });
        }
        Ok(law)
    }

    /// A user's law on a shell or beam, that is told the time.
    fn surface_law(
        &mut self,
        law: &UserFunction<SurfaceForceLaw>,
        cycles: usize,
    ) -> Result<SurfaceForceLaw> {
        let zero = SurfaceForceLaw {
            function: Arc::new(|_, _| Ok(())),
            gives_tangents: true,
            frame: LoadFrame::Space,
        };
        let mut law = self.function(law, zero)?;
        if cycles > 0 {
            let (unit, function) = (self.phase_unit()? * cycles as f64, law.function);
            law.function = Arc::new(move |state, out| {
                let time = state.time * unit;
                function(&SurfaceForceInput { time, ..*state }, out)
            });
        }
        Ok(law)
    }

    /// A user's forces on nodes, whose function is told the time. Motions are of the order of
    /// `length`.
    pub(super) fn node_forces(
        &mut self,
        (nodes, apart): (&[usize], bool),
        (law, cycles): (&UserFunction<NodeForceLaw>, usize),
        length: f64,
    ) -> Result<UserForce> {
        let law = self.node_law(law, cycles)?;
        let frequency = TAU / self.system.period();
        let force = UserForce::new(nodes.to_vec(), law, length, frequency);
        Ok(force.with_nodes_apart(apart))
    }

    /// A user's forces on an element, whose function is told the time. Motions are of the order of
    /// `length`.
    pub(super) fn surface_force(
        &mut self,
        (element, place): (usize, ForcePlace),
        (law, cycles): (&UserFunction<SurfaceForceLaw>, usize),
        length: f64,
    ) -> Result<SurfaceForce> {
        let law = self.surface_law(law, cycles)?;
        let sizes = [length, TAU / self.system.period()];
        match place.on_shell() {
            Some(place) => {
                let shell = &*self.system.shells[element];
                SurfaceForce::on_shell((element, shell), place, law, sizes)
            }
            None => {
                let beam = &*self.system.beams[element];
                SurfaceForce::along_beam((element, beam), place, law, sizes)
            }
        }
    }

    /// Phase in a unit of time, for functions of it.
    fn phase_unit(&self) -> Result<f64> {
        let regime = &self.system.regime;
        let is_known = match regime.standstill() {
            Some(standstill) => standstill.time == 0.0 || standstill.period.is_some(),
            None => regime.knows_period(),
        };
        if is_known {
            return Ok(TAU / regime.period());
        }
        let expected = "the period that its phase is of";
        Err(Error::value("options.period", expected, "none"))
    }

    /// A controller, whose function is told the time. Motions are of the order of `length`.
    pub(super) fn controller(
        &mut self,
        definition: &ControllerDefinition,
        length: f64,
    ) -> Result<Controller> {
        let zero = ControllerLaw {
            function: Arc::new(|_, _| Ok(())),
            gives_tangents: true,
        };
        let mut law = self.function(&definition.law, zero)?;
        if definition.cycles > 0 {
            let unit = self.phase_unit()? * definition.cycles as f64;
            let function = law.function;
            law.function = Arc::new(move |input, out| {
                let time = input.time * unit;
                function(&ControllerInput { time, ..*input }, out)
            });
        }
        let frequency = TAU / self.system.period();
        let scales = definition.inputs.iter();
        let scales = scales.map(|at| coordinate_scales(at.coordinate, length, frequency));
        let scales = scales.collect();
        let inputs = definition
            .inputs
            .iter()
            .map(|at| self.acted_on(at))
            .collect();
        let outputs = definition
            .outputs
            .iter()
            .map(|at| self.acted_on(at))
            .collect();
        let states = definition.states.clone();
        Ok(Controller::new(inputs, outputs, states, law, scales))
    }
}
