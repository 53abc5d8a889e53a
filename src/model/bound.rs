//! Functions of the user in the place of those of a model: of one from a file, which holds none.

use super::{ForceDefinition, Model, UserFunction};
use crate::elements::{ControllerLaw, CoordinateLaw, NodeForceLaw, SurfaceForceLaw};
use crate::error::{Error, ErrorKind, Result};

impl Model {
    /// Gives a coordinate law its function, or another: that of a model that was loaded is not in
    /// the file.
    ///
    /// # Errors
    /// If there is no such force, or it is no coordinate law.
    pub fn bind_coordinate_law(&mut self, force: usize, law: CoordinateLaw) -> Result<()> {
        *self.coordinate_law_mut(force)? = UserFunction::new(law);
        Ok(())
    }

    /// Gives forces on nodes their function, likewise.
    ///
    /// # Errors
    /// If there is no such force, or it is none of a function on nodes.
    pub fn bind_node_forces(&mut self, force: usize, law: NodeForceLaw) -> Result<()> {
        *self.node_forces_mut(force)? = UserFunction::new(law);
        Ok(())
    }

    /// Gives forces on a shell or beam element their function, likewise.
    ///
    /// # Errors
    /// If there is no such force, or it is none of a function on a shell or beam.
    pub fn bind_surface_forces(&mut self, force: usize, law: SurfaceForceLaw) -> Result<()> {
        *self.surface_forces_mut(force)? = UserFunction::new(law);
        Ok(())
    }

    /// Gives a controller its function, likewise.
    ///
    /// # Errors
    /// If there is no such force, or it is no controller.
    pub fn bind_controller(&mut self, force: usize, law: ControllerLaw) -> Result<()> {
        *self.controller_law_mut(force)? = UserFunction::new(law);
        Ok(())
    }

    /// The function of a coordinate law.
    ///
    /// # Errors
    /// If there is no such force, or it is no coordinate law.
    pub(crate) fn coordinate_law_mut(
        &mut self,
        force: usize,
    ) -> Result<&mut UserFunction<CoordinateLaw>> {
        self.function_mut(force, "coordinate law", |force| match force {
            ForceDefinition::CoordinateLaw { law, .. } => Some(law),
            _ => None,
        })
    }

    /// The function of forces on nodes, likewise.
    ///
    /// # Errors
    /// If there is no such force, or it is none of a function on nodes.
    pub(crate) fn node_forces_mut(
        &mut self,
        force: usize,
    ) -> Result<&mut UserFunction<NodeForceLaw>> {
        self.function_mut(force, "function's force on nodes", |force| match force {
            ForceDefinition::NodeForces { law, .. } => Some(law),
            _ => None,
        })
    }

    /// The function of forces on a shell or beam element, likewise.
    ///
    /// # Errors
    /// If there is no such force, or it is none of a function on a shell or beam.
    pub(crate) fn surface_forces_mut(
        &mut self,
        force: usize,
    ) -> Result<&mut UserFunction<SurfaceForceLaw>> {
        self.function_mut(
            force,
            "function's force on a shell or beam",
            |force| match force {
                ForceDefinition::SurfaceForces { law, .. } => Some(law),
                _ => None,
            },
        )
    }

    /// The function of a controller, likewise.
    ///
    /// # Errors
    /// If there is no such force, or it is no controller.
    pub(crate) fn controller_law_mut(
        &mut self,
        force: usize,
    ) -> Result<&mut UserFunction<ControllerLaw>> {
        self.function_mut(force, "controller", |force| match force {
            ForceDefinition::Controller(controller) => Some(&mut controller.law),
            _ => None,
        })
    }

    fn function_mut<F>(
        &mut self,
        force: usize,
        what: &str,
        of: impl FnOnce(&mut ForceDefinition) -> Option<&mut UserFunction<F>>,
    ) -> Result<&mut UserFunction<F>> {
        self.require_force("force", force)?;
        of(&mut self.forces[force]).ok_or_else(|| {
            let message = format!("force: {force} is no {what}");
            Error::new(ErrorKind::NotAvailable, message)
        })
    }
}
