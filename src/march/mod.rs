//! Marching in time, where no static equilibrium tells where the system is.

mod backward;

pub(crate) use backward::march_to_periodic;
