//! From the keys of a file to a scene that makes sense.

use super::error::{Document, SceneError};
use super::errors::errors;
use super::file::{GrippersTable, MotionKind, PlyTable, SceneKeys};
use super::limits::limits;
use super::located::{Count, Located, Whole};
use super::motion::{motion, unplanned};
use super::plan::plan;
use super::settings::settings;
use super::trajectory::trajectory;
use super::{SceneFile, material, mold, named, sheet, start, target};
use crate::shown;
use crate::size::{self, SizeError};
use plydrape::mold::Mold;
use plydrape::ply::{Direction, Grid, Ply};
use plydrape::scene::{Motion, Scene, Target};
use std::ops::Range;
use std::path::Path;

/// Most grippers along u or v.
const MOST_GRIPPERS: i128 = 1000;

/// Checks a scene file, on a mold of its own or on one that a program has `made`; other files it names are relative to `base`.
pub(super) fn scene(
    file: &SceneKeys,
    made: Option<Mold>,
    document: &Document,
    base: &Path,
) -> Result<SceneFile, SceneError> {
    let ply = ply(&file.ply, document, base)?;
    let (mold, mesh) = match &file.mold {
        Some(table) => {
            let (mold, report) = mold::mold(&table.value, &ply, document, base)?;
            (Some(mold), report)
        }
        None => (made, None),
    };
    let settings = settings(file, &ply, document)?;
    let places = Surroundings {
        ply: &ply,
        mold: mold.as_ref(),
        tolerance: settings.contact.tolerance,
        document,
        base,
    };
    // too many grippers for a single step are refused before a net is draped for them
    places.fits(&file.ply.grippers.span, 1)?;
    let target = match &file.target {
        Some(table) => Some(target::target(table, &ply, mold.as_ref(), document, base)?),
        None => None,
    };
    let motion = places.motion(file, target.as_ref())?;
    places.fits(&file.ply.grippers.span, motion.positions.len())?;
    let limits = limits(&file.limits, &ply, &settings, document)?;
    let sheets = sheet::fits(file, &ply, &settings, motion.positions.len(), document)?;
    let plan = plan(&file.plan, ply.grid, document)?;
    let errors = match &file.errors {
        Some(table) => Some(errors(table, &ply, mold.is_some(), document)?),
        None => None,
    };
    let unplanned = file.motion.as_ref().and_then(|table| unplanned(&table.value, document));
    let steps = file.plan.steps.as_ref().map_or(&file.ply.grippers.span, |steps| &steps.span);
    let fits = places.allowed(steps, size::plan(&ply, &plan, sheets));
    let title = title(file.title.as_ref(), document, base)?;
    Ok(SceneFile {
        scene: Scene { title, ply, mold, motion, target, settings, limits, plan, errors },
        input: Some(document.text.clone()),
        files: named(document, base),
        mesh,
        plan_refusal: unplanned.or(fits.err()).map(Box::new),
    })
}

/// The title that is written, or else the file's name without its ending; its folder's, if the file is just `scene.toml`.
pub(super) fn title(
    written: Option<&Located<String>>,
    document: &Document,
    base: &Path,
) -> Result<String, SceneError> {
    if let Some(title) = written {
        return line(title, document);
    }
    let stem = Path::new(&document.file).file_stem().unwrap_or_default();
    let name = match base.file_name() {
        Some(folder) if stem == "scene" => folder,
        _ => stem,
    };
    Ok(shown::name(&name.to_string_lossy()))
}

/// A text for people, of one line: control characters would move the cursor of a terminal.
pub(super) fn line(text: &Located<String>, document: &Document) -> Result<String, SceneError> {
    match shown::control(&text.value) {
        None => Ok(text.value.clone()),
        Some(found) => Err(document.error(
            text.span.clone(),
            format!("this text holds the control character {}", found.escape_unicode()),
            "remove it: one line of plain text is wanted",
        )),
    }
}

pub(super) fn ply(table: &PlyTable, document: &Document, base: &Path) -> Result<Ply, SceneError> {
    let [nu, nv] = &table.grippers.value.0;
    let grid =
        Grid { nu: gripper_count(nu, 2, "u", document)?, nv: gripper_count(nv, 1, "v", document)? };
    let [a, b] = &table.cell.0;
    Ok(Ply {
        grid,
        cell: [a.size(document)?, b.size(document)?],
        material: material::material(&table.material, document, base)?,
        warp: table.warp.map_or(Direction::U, Direction::from),
        length_factor: 1.0,
    })
}

fn gripper_count(
    count: &Located<Count>,
    least: i128,
    along: &str,
    document: &Document,
) -> Result<usize, SceneError> {
    let Whole(value) = count.value;
    if (least..=MOST_GRIPPERS).contains(&value)
        && let Ok(value) = usize::try_from(value)
    {
        return Ok(value);
    }
    Err(document.error(
        count.span.clone(),
        format!("there cannot be {value} grippers along {along}"),
        format!(
            "{least} to {MOST_GRIPPERS} grippers are possible along {along}, as in grippers = [4, 2]; [4, 1] is a strip"
        ),
    ))
}

/// What gripper positions are read and checked against.
pub(super) struct Surroundings<'a> {
    pub ply: &'a Ply,
    pub mold: Option<&'a Mold>,
    /// Depth in the mold that still counts as touching it (m).
    pub tolerance: f64,
    pub document: &'a Document,
    pub base: &'a Path,
}

impl Surroundings<'_> {
    /// Refuses a drape of so many steps if its result would be too large; `span` is what the scene says of that.
    pub fn fits(&self, span: &Range<usize>, steps: usize) -> Result<(), SceneError> {
        self.allowed(span, size::drape(self.ply, steps))
    }

    fn allowed(&self, span: &Range<usize>, size: Result<(), SizeError>) -> Result<(), SceneError> {
        size.map_err(|fault| self.document.error(span.clone(), fault.to_string(), fault.remedy()))
    }

    fn motion(&self, file: &SceneKeys, target: Option<&Target>) -> Result<Motion, SceneError> {
        let &Surroundings { ply, document, base, .. } = self;
        let from_file = file.motion.as_ref().filter(|m| m.value.kind == MotionKind::File);
        if let Some(table) = from_file {
            if let Some(grippers) = &file.grippers
                && let Some(key) = placing_key(&grippers.value)
            {
                return Err(document.error(
                    grippers.span.clone(),
                    format!("the start is given twice: by `{key}` and by the motion's file"),
                    format!(
                        "remove `{key}`: beside a motion file [grippers] says what they are, as in `stiffness`, not where they start"
                    ),
                ));
            }
            let (motion, start) = trajectory(table, ply, document, base)?;
            start::check(&start, self)?;
            return Ok(motion);
        }
        let start = match (&file.grippers, target.and_then(|target| target.drape.as_ref())) {
            (None, Some(net)) => start::above(net, &file.ply.grippers.span, self),
            (Some(table), Some(net)) if start::is_open(&table.value) => {
                start::above(net, &table.span, self)
            }
            (Some(table), _) => start::start(table, self, target)?,
            (None, None) => {
                return Err(document.error(
                    file.ply.grippers.span.clone(),
                    "the scene does not say where the grippers start",
                    "add [grippers] with spacing = [\"98 mm\", \"98 mm\"] and height = \"75 mm\", or with `positions`; or a [target] to start above",
                ));
            }
        };
        start::check(&start, self)?;
        if let Some(steps) = file.motion.as_ref().and_then(|table| table.value.steps.as_ref()) {
            // before so many positions are made
            let Whole(count) = steps.value;
            self.fits(&steps.span, usize::try_from(count).unwrap_or(0))?;
        }
        motion(file.motion.as_ref(), &start, target, ply, document)
    }
}

/// A key that says where the grippers are.
fn placing_key(keys: &GrippersTable) -> Option<&'static str> {
    [
        ("positions", keys.positions.is_some()),
        ("spacing", keys.spacing.is_some()),
        ("height", keys.height.is_some()),
    ]
    .into_iter()
    .find_map(|(key, present)| present.then_some(key))
    .or(start::other_key(keys))
}
