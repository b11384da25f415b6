//! A planned result for a ply that lies elsewhere than planned: what [`plydrape::planner::replan`] needs of a result that was read, and the
//! result of what it finds.

use crate::Error;
use crate::result::ResultFile;
use crate::result::sheet::{SheetFile, SheetKept, SheetState};
use crate::scene::SeenOffset;
use crate::text::table::significant;
use plydrape::layup::Model;
use plydrape::measure::Name;
use plydrape::pick_up::Offset;
use plydrape::planner::replan::{KnownPlan, Replanned, Replanner, SheetShapes};
use plydrape::scene::{self, Scene};
use std::path::Path;
use std::sync::OnceLock;

/// How far a ply lies from where it was planned at most (m), unless somebody says that it does lie there.
const FAR_SHIFT: f64 = 0.05;
/// How far a ply is turned from where it was planned at most (°), unless somebody says that it is.
const FAR_YAW_DEG: f64 = 10.0;

/// A planned result and what its correction needs.
#[derive(Debug)]
pub struct PlannedResult {
    result: ResultFile,
    scene: Scene,
    sheet: Option<SheetShapes>,
}

impl PlannedResult {
    /// Prepares a result.
    ///
    /// # Errors
    /// [`Error`] if it was not planned, or the states of its sheet cannot be read.
    pub fn new(result: ResultFile) -> Result<Self, Error> {
        let Some(record) = &result.plan else { return Err(not_planned()) };
        let echo = &result.scene;
        let scene = Scene {
            title: echo.title.clone(),
            layup: result.layup(),
            limits: echo.limits.clone(),
            plan: scene::PlanSettings {
                method: record.method,
                rate: record.rate,
                ..scene::PlanSettings::default()
            },
            errors: echo.errors,
            also: false,
            book_ply: echo.book_ply.clone(),
        };
        let kept = result.sheet_states.as_ref().filter(|_| result.model() == Model::Sheet);
        let sheet = kept.map(|kept| shapes(&result, kept)).transpose()?;
        Ok(PlannedResult { result, scene, sheet })
    }

    /// The result.
    #[must_use]
    pub fn result(&self) -> &ResultFile {
        &self.result
    }

    /// Scene, as it was understood, with the motion of the plan.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// How far seen points may be from where an offset puts them (m): as far as points of the ply may land from their places.
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        self.scene.limits.most(Name::Position)
    }

    /// What answers offsets with motions.
    ///
    /// # Errors
    /// [`Error`] if the plan has no transport in which an offset could be taken out.
    pub fn replanner(&self) -> Result<Replanner<'_>, Error> {
        let ResultFile { plan, steps, summary, .. } = &self.result;
        let Some(record) = plan else { return Err(not_planned()) };
        let plan = KnownPlan { scene: &self.scene, record, steps, summary };
        Ok(Replanner::new(plan, self.sheet.as_ref())?)
    }

    /// The motion for a ply that was seen.
    ///
    /// # Errors
    /// [`Error`] if it was seen more than 50 mm or 10° from where it was planned, about the middle of the grippers, and nobody said that it does
    /// lie there ([`SeenOffset::far`]); those of [`Replanner::replan`].
    pub fn replan(&self, replanner: &Replanner, seen: &SeenOffset) -> Result<Replanned, Error> {
        let places = &self.scene.layup.motion.positions[0];
        let middle = [0, 1].map(|c| places.iter().map(|p| p[c]).sum::<f64>() / places.len() as f64);
        let Offset { shift: [x, y], yaw, .. } = seen.offset.about(middle);
        let shift = x.hypot(y);
        if !seen.far && (shift > FAR_SHIFT || yaw.abs() > FAR_YAW_DEG.to_radians()) {
            return Err(Error::not_possible(
                format!(
                    "the ply would lie {} mm and {}° from where it was planned, and more than {} mm or {FAR_YAW_DEG}° is asked about",
                    significant(1e3 * shift),
                    significant(yaw.to_degrees()),
                    1e3 * FAR_SHIFT
                ),
                "look at the unit and at the frame of the camera; if it does lie there, say `far = true` beside the offset or the points, or --far (in Python far=True)",
            ));
        }
        Ok(replanner.replan(&seen.offset, seen.residual)?)
    }

    /// The result of a corrected plan, of the model that decides alone; the moved states of its sheet are kept in a hidden folder within `dir`.
    ///
    /// # Errors
    /// [`Error`] if the states of the sheet cannot be read or kept.
    pub fn corrected(&self, replanned: Replanned, dir: &Path) -> Result<ResultFile, Error> {
        let result = &self.result;
        let kept = result.sheet_states.as_ref().filter(|_| result.model() == Model::Sheet);
        let states = kept.map(|kept| self.states(kept, &replanned, dir)).transpose()?;
        let Replanned { record, motion, attitudes, steps, summary, .. } = replanned;
        let corrected = ResultFile {
            program: crate::PROGRAM.into(),
            scene: result.scene.clone(),
            plan: None,
            summary,
            sheet_states: states,
            steps,
            also: None,
            files: result.files.clone(),
            motion: OnceLock::new(),
        };
        Ok(corrected.with_plan(record, motion, attitudes))
    }

    /// The states of the sheet, moved.
    fn states(
        &self,
        kept: &SheetKept,
        replanned: &Replanned,
        dir: &Path,
    ) -> Result<SheetKept, Error> {
        let mut file = kept.open()?;
        let planned = self.result.steps.last().map_or(0.0, |step| step.time);
        let mut states = Vec::with_capacity(file.states());
        for n in 0..file.states() {
            let Some(mut state) = file.state(n)? else { break };
            self.follow(&mut state, replanned, planned);
            states.push(state);
        }
        SheetFile::new(dir, file.mesh(), file.landing_step(), &states).map(SheetKept::made)
    }

    /// Moves a state to where it is in the corrected motion.
    fn follow(&self, state: &mut SheetState, replanned: &Replanned, planned: f64) {
        state.time = replanned.time(state.time, planned);
        let step = (state.step as usize).saturating_sub(1);
        if !replanned.is_moved(step) {
            return;
        }
        let place = |p: &mut [f64; 3]| *p = replanned.place(step, *p);
        state.positions.to_mut().iter_mut().for_each(place);
        state.grippers.to_mut().iter_mut().for_each(place);
        for force in state.pad_forces.to_mut() {
            *force = replanned.turn(step, *force);
        }
        for turned in state.pad_rotation.to_mut() {
            *turned = replanned.orientation(step, *turned);
        }
        if let Some(mold) = &self.scene.layup.mold {
            let places = &state.positions;
            let height = |p: &[f64; 3]| mold.signed_distance(*p);
            state.height = places.iter().map(height).collect();
        }
    }
}

/// Refuses a result that was not planned.
fn not_planned() -> Error {
    Error::not_possible(
        "the result is not that of a plan: its motion is the scene's",
        "give the result.json of `plydrape plan`; of a scene's own motion, change the scene",
    )
}

/// The states of a sheet up to its first contact.
fn shapes(result: &ResultFile, kept: &SheetKept) -> Result<SheetShapes, Error> {
    let first = result.summary.first_contact_step();
    let last = first.unwrap_or(result.steps.len());
    let mut states = kept.open()?;
    let places = states.mesh().places.to_vec();
    let mut shapes = SheetShapes { places, states: Vec::new() };
    for n in 0..states.states() {
        let Some(state) = states.state(n)? else { break };
        let step = state.step as usize;
        let is_new = shapes.states.last().is_none_or(|(before, _)| before + 1 < step);
        if step > last || !is_new {
            break;
        }
        shapes.states.push((step.saturating_sub(1), state.positions.into_owned()));
    }
    Ok(shapes)
}
