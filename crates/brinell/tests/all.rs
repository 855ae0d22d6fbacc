//! The crate's tests in one program, because each program links the library anew; `allocations.rs` and
//! `damage_allocations.rs` need processes of their own.

mod accuracy;
mod any_scenario;
mod architecture;
mod balls;
mod coefficients;
mod common;
mod conservation;
mod convergence;
mod custom;
mod damage;
mod document;
mod doubts;
mod examples;
mod film;
mod kernels;
mod kinematics;
mod lamina;
mod literature;
mod machine;
mod mechanics;
mod observe;
mod plausibility;
mod run_loop;
mod sensor;
mod shapes;
mod signal_on_runs;
mod statics;
mod symmetry;
mod tilting;
mod trajectories;
mod work;
