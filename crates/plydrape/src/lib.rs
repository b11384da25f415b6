//! How an array of grippers must move to lay a carbon-fiber ply on a curved mold without wrinkles.
//!
//! A ply hangs between grippers above a mold. [`plan`] finds the motion of the grippers that lays it down, [`simulate`] follows a motion
//! that is given. Both give the outcome of **one** model of the ply, the one that the scene chooses: the *sheet*, the whole ply simulated
//! as cloth with the laws of a woven material, contact and friction, or the *catenaries* with bending stiffness between the grippers of
//! Krogh, Jakobsen and Sherwood 2018 (arXiv:1810.07619). The outcome has every limit of the scene, judged; it is accepted if all of them
//! hold.
//!
//! ```text
//!        o     o     o     o       grippers: where the robot holds the ply
//!        |     |     |     |
//!     ___o_____o_____o_____o___    the ply: sheet or catenaries
//!         \___/ \___/ \___/
//!                 ___
//!           __---     ---__        the mold, with the ideal drape as the target
//!        .-~               ~-.
//! ```
//!
//! # From a mold to a planned motion
//!
//! ```
//! use plydrape::measure::Name;
//! use plydrape::mold::{Face, Pose, Sphere};
//! use plydrape::ply::Grid;
//! use plydrape::{Material, Mold, Ply, Scene, plan};
//! use std::ops::ControlFlow;
//!
//! // a prepreg of 314 g/m², held at the corners of 100 mm, on a dome of 1 m radius
//! let prepreg = Material::woven("prepreg", 0.3143, 9e-5, 1e6, 5.0);
//! let ply = Ply::of_array(Grid { nu: 2, nv: 2 }, [0.1, 0.1], prepreg);
//! let pose = Pose::upright([0.0, 0.0, -1.0]);
//! let dome = Mold::Sphere(Sphere { pose, radius: 1.0, face: Face::Outside });
//! let mut scene = Scene::above(ply, dome, [0.0, 0.0])?;
//! scene.limits.set(Name::Height, Some(0.5e-3));
//!
//! // the motion, and the verdict of the sheet along it
//! let planned = plan(&scene, None, &mut |_| ControlFlow::Continue(()))?;
//! assert!(planned.accepted());
//! let summary = &planned.outcome.drape.summary;
//! let height = summary.limits.iter().find(|verdict| verdict.name == Name::Height);
//! assert!(height.is_some_and(|height| height.ok && height.value < 0.5));
//! let end = planned.motion.at(planned.motion.duration());
//! assert_eq!(end.len(), 4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Stages
//!
//! A folder is a stage of the method, and each uses only those above it; a test holds that order. The first two rows are crates of their
//! own, whose front pages say more of each stage. This crate hands on their modules, so that a program needs it alone.
//!
//! | stage | what it is |
//! |---|---|
//! | [`geometry`], [`mold`], [`material`], [`ply`], [`net`], [`motion`], [`bodies`], [`arm`], [`tool`], [`layup`], [`clearance`], [`placement`], [`state`] | the crate [`plydrape_layup`]: one ply and how it is laid, which every model of the ply drapes |
//! | [`catenary`], [`elastica`], [`equilibrium`], [`draping`] | the crate [`plydrape_catenary`]: the paper's model, from one span to the motion step by step with contact |
//! | [`fit`] | material laws from measured tables |
//! | [`sheet`] | the whole ply as cloth: stretch, shear, bending, contact, friction, pads on mounts |
//! | [`pick_up`] | where the ply was picked up, if not where it was planned |
//! | [`measure`] | what is measured of a state or a motion, its limit, and the verdict |
//! | [`errors`] | how far a real cell may be from its scene |
//! | [`scene`] | a layup, its limits, and how its motion is planned |
//! | [`outcome`] | the drape by the model that decides, and the verdict that follows from it |
//! | [`planner`] | gripper trajectories, and limits that no trajectory can keep; the stepwise one is that of [`plydrape_catenary::stepwise`] |
//!
//! # Settings
//!
//! Every setting is a public field: rules of the models in [`layup::Settings`] (`scene.layup.settings.contact.friction`, `.pad.radius`,
//! `.sheet.mesh`, `.model`), the search in [`scene::PlanSettings`] (`scene.plan.seed`, `.evaluations`), errors in [`errors::Errors`]. Limits are
//! a map from measures to bounds, [`measure::Limits`]: `scene.limits.set(Name::Tilt, Some(0.5))`; without a bound of the scene each
//! measure has its usual one, with its reason. The numerical settings of the sheet are in [`sheet::SheetTuning`].
//!
//! SI units throughout, z up, gravity along −z. Equations are numbered in `docs/theory` of the project. This crate reads and writes no
//! files, `plydrape-io` does; with the feature `serde` its types can be written by serde.

mod error;
pub mod errors;
pub mod fit;
pub mod measure;
pub mod outcome;
pub mod pick_up;
pub mod planner;
pub mod scene;
pub mod sheet;

pub use error::Error;
pub use errors::Errors;
pub use measure::Limits;
pub use outcome::{Outcome, simulate};
pub use planner::{Planned, plan};
pub use plydrape_catenary::{
    Error as CatenaryError, Solver, catenary, draping, elastica, equilibrium,
};
pub use plydrape_layup::{
    Error as LayupError, Layup, Material, Mold, Motion, Ply, Settings, Target, arm, bodies,
    clearance, geometry, layup, material, mold, motion, net, placement, ply, state, stopwatch,
    tool,
};
pub use scene::{PlanSettings, Scene};
