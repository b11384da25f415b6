//! How an array of grippers must move to lay a carbon-fibre ply on a mold without wrinkles.
//!
//! The ply is a net of catenaries with bending stiffness hung between the grippers, after Krogh,
//! Jakobsen and Sherwood 2018; the equations are numbered in `docs/theory`. Modules follow the
//! stages of the method, and data flows one way:
//!
//! 1. [`scene`]: a file becomes a checked [`scene::Scene`];
//! 2. [`mold`], [`catenary`]: the surface, and one span of ply;
//! 3. [`net`]: the ideal drape, where every point of the fabric should end on the mold;
//! 4. [`ply`]: grippers, edges, diagonals, shear and the slope rules;
//! 5. [`equilibrium`]: all horizontal forces and shared slopes at given gripper positions;
//! 6. [`draping`]: the motion step by step, contact with the mold, the measures;
//! 7. [`motion`]: positions step by step become smooth in time, within limits of speed, acceleration, jerk;
//! 8. [`planner`]: gripper trajectories, and what no trajectory can do;
//! 9. [`output`]: result files and the figure.
//!
//! SI units throughout, z up, gravity along −z.

pub mod catenary;
pub mod draping;
pub mod equilibrium;
pub mod material;
pub mod measure;
pub mod mold;
pub mod motion;
pub mod net;
pub mod planner;
pub mod ply;
pub mod scene;
