//! From the keys of a file to a scene that makes sense.

use super::bodies::bodies;
use super::cell::cell;
use super::choice::WarpChoice;
use super::cut::CupArray;
use super::diagnostic::hint;
use super::errors::errors;
use super::file::{ErrorsTable, GrippersTable, MotionKind, PlyTable, SceneKeys};
use super::limits::{limits, not_measured};
use super::located::{Count, Fixed, Located, Whole};
use super::model::Models;
use super::motion::{motion, unplanned};
use super::pick_up::pick_up;
use super::plan::plan;
use super::quantity::{Read, read_given, read_or};
use super::release::release;
use super::settings::{self, settings};
use super::source::Document;
use super::trajectory::trajectory;
use super::{SceneFile, cut, material, mold, named, rate, robot, start, target, tool};
use crate::Error;
use crate::read::outline::Drawn;
use crate::store::shown;
use crate::store::size;
use plydrape::layup::{Layup, Target};
use plydrape::mold::{MeshReport, Mold};
use plydrape::motion::Motion;
use plydrape::ply::{Direction, FoundLines, Grid, PickUpError, Ply};
use plydrape::scene::{Cell, Scene};
use plydrape::tool::Tool;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

/// Most grippers along u or v.
const MOST_GRIPPERS: i128 = 1000;

/// Checks a scene file, on a mold of its own or on one that a program has `made`.
pub(super) fn scene(
    file: &SceneKeys,
    made: Option<Mold>,
    document: &Document,
) -> Result<SceneFile, Error> {
    let grippers = file.grippers.as_ref().map(|table| &table.value);
    let (ply, CutRead { cups, drawn }) = ply(&file.ply, grippers, document)?;
    let tolerance = settings::contact(file, &ply, document)?.tolerance;
    let (mold, mesh) = match &file.mold {
        Some(table) => {
            let (mold, report) = mold::mold(&table.value, &ply, tolerance, document)?;
            (Some(mold), report)
        }
        None => (made, None),
    };
    let named_cell = file.cell.as_ref().map(|table| cell(table, &ply, document)).transpose()?;
    let cell = named_cell.as_ref().map_or_else(Cell::default, |named| named.cell);
    let settings = settings(file, &cell, &ply, document)?;
    let models = Models::named(file, settings.model, document)?;
    models.check_lines(&ply)?;
    models.check_mounts(named_cell.as_ref())?;
    let turn = cut::from_warp(&file.ply.value, &ply, document)?;
    let places = Surroundings {
        ply: &ply,
        turn,
        mold: mold.as_ref(),
        tolerance: settings.contact.tolerance,
        document,
    };
    // too many grippers for a single step are refused before a net is draped for them
    places.fits(file.grippers_span(), 1)?;
    let target = match &file.target {
        Some(table) => Some(target::target(table, &ply, turn, mold.as_ref(), document)?),
        None => None,
    };
    let motion = places.motion(file, target.as_ref())?;
    places.fits(file.grippers_span(), motion.positions.len())?;
    let sheets = models.check_sheets(&ply, &settings, motion.positions.len())?;
    let plan = plan(&file.plan, ply.grippers(), settings.pad.gives(), document)?;
    let (arm, links) = robot::robot(file, document)?;
    let bodies = bodies(file, links, document)?;
    let errors = match (&file.errors, cell.errors) {
        (None, None) => None,
        (table, of_cell) => {
            let nothing = ErrorsTable::default();
            let table = table.as_ref().unwrap_or(&nothing);
            Some(errors(table, of_cell, &ply, mold.is_some(), document)?)
        }
    };
    let release = release(file, &cell, settings.model, mold.is_some(), document)?;
    let unplanned = file.motion.as_ref().and_then(|table| unplanned(&table.value, document));
    let steps = file.plan.steps.as_ref().map_or(file.grippers_span(), |steps| &steps.span);
    let fits = places.allowed(steps, size::plan(&ply, &plan, sheets));

    // limits and tool are those of the rest of the layup
    let mut layup =
        Layup { ply, mold, motion, target, settings, bodies, tool: None, release, pick_up: None };
    let limits = limits(&file.limits, &layup, document)?;
    if let (Some(table), Some(start)) = (&file.tool, layup.motion.positions.first()) {
        layup.tool = Some(Tool { arm, ..tool::tool(table, &layup, start, &limits, document)? });
    }
    models.check_built(&layup)?;
    if let Some(table) = &file.pick_up {
        pick_up(table, file, &mut layup, models.has_also(), document)?;
    }
    let mut notices = file.limits.notices();
    notices.extend(not_measured(&limits, &layup));
    let title = title(file.title.as_ref(), document)?;
    let thickness = read_given(&file.ply.value.thickness, document)?;
    Ok(SceneFile {
        scene: Scene {
            title,
            layup,
            limits,
            plan,
            errors,
            also: models.has_also(),
            book_ply: None,
        },
        input: Some(document.text.clone()),
        files: named(document),
        mesh,
        cups,
        drawn,
        cell: named_cell.map(|named| named.name),
        thickness,
        notices,
        plan_refusal: unplanned.or(fits.err()).and_then(Error::into_diagnostic),
    })
}

/// As [`scene`], on a mold that a program has made and that is read as one of a file is.
pub(super) fn scene_on(
    file: &SceneKeys,
    made: Mold,
    document: &Document,
) -> Result<SceneFile, Error> {
    let grippers = file.grippers.as_ref().map(|table| &table.value);
    let (ply, _) = ply(&file.ply, grippers, document)?;
    let tolerance = settings::contact(file, &ply, document)?.tolerance;
    scene(file, Some(seen_by_plies(made, &ply, tolerance)), document)
}

/// A mold that a program has made, with boundaries of its faces stitched and pits and holes spanned as those of a file are.
fn seen_by_plies(mold: Mold, ply: &Ply, tolerance: f64) -> Mold {
    let Mold::Mesh(mesh) = &mold else { return mold };
    // what cannot be stitched stays as it is
    let stitched = mesh.stitched(tolerance).ok().flatten();
    let (stitched, report) = stitched.unwrap_or_else(|| ((**mesh).clone(), MeshReport::default()));
    let width = mold::usual_width(ply);
    let (seen, _) = stitched.spanned(report, width, width, tolerance);
    if seen == **mesh { mold } else { Mold::Mesh(Arc::new(seen)) }
}

/// The title that is written, or else the file's name without its ending; its folder's, if the file is just `scene.toml`.
pub(super) fn title(
    written: Option<&Located<String>>,
    document: &Document,
) -> Result<String, Error> {
    if let Some(title) = written {
        return line(title, document);
    }
    let stem = Path::new(&document.file).file_stem().unwrap_or_default();
    let name = match document.folder.file_name() {
        Some(folder) if stem == "scene" => folder,
        _ => stem,
    };
    Ok(shown::name(&name.to_string_lossy()))
}

/// A text for people, of one line: control characters would move the cursor of a terminal.
pub(super) fn line(text: &Located<String>, document: &Document) -> Result<String, Error> {
    match shown::control(&text.value) {
        None => Ok(text.value.clone()),
        Some(found) => Err(document.error(
            text.span.clone(),
            format!("this text holds the control character {}", found.escape_unicode()),
            "remove it; a title is one line of plain text",
        )),
    }
}

/// What was read of a ply that is cut, beside the ply; nothing of another one.
#[derive(Default)]
pub(super) struct CutRead {
    /// The array of cups over it.
    cups: Option<CupArray>,
    /// Drawing.
    drawn: Option<Drawn>,
}

/// The ply, and what else was read of one that is cut; `grippers` is the table that says how large their pads are.
pub(super) fn ply(
    ply: &Located<PlyTable>,
    grippers: Option<&GrippersTable>,
    document: &Document,
) -> Result<(Ply, CutRead), Error> {
    // the material, at the temperature of the ply
    let table = &ply.value;
    let mut material = material::material(&table.material, document)?;
    if let Some(temperature) = &table.temperature {
        rate::set_temperature(&mut material, temperature, document)?;
    }

    // a ply that is cut: its outline and its cups give grid, cell and warp
    if cut::is_cut(table) {
        let radius = grippers.and_then(|grippers| grippers.pad_radius.clone());
        let radius = read_or(&radius, 0.0, document)?;
        let cut::Shape { grid, cell, warp, cut, array: cups, drawn } =
            cut::shape(ply, radius, document)?;
        let (cut, found) = (Some(cut), FoundLines::default());
        let (length_factor, pick_up_error) = (1.0, PickUpError::default());
        let ply = Ply { grid, cell, material, warp, length_factor, pick_up_error, cut, found };
        return Ok((ply, CutRead { cups, drawn }));
    }

    // a ply that ends at its grippers: its warp runs along u or along v
    let Some(cell) = &table.cell else { return Err(missing("cell", ply, document)) };
    let warp = match &table.warp {
        None | Some(Located { value: WarpChoice::U, .. }) => Direction::U,
        Some(Located { value: WarpChoice::V, .. }) => Direction::V,
        Some(Located { value: WarpChoice::Angle(_), span }) => {
            return Err(document.error(
                span.clone(),
                "the warp of a ply that ends at its grippers runs along u or along v",
                "write \"u\" or \"v\"; or give the ply its `size` or its `outline`, and then the angle from the drawing's x axis to the warp",
            ));
        }
    };
    let ply = Ply {
        grid: grid(ply, document)?,
        cell: cell.read(document)?,
        material,
        warp,
        length_factor: 1.0,
        pick_up_error: PickUpError::default(),
        cut: None,
        found: FoundLines::default(),
    };
    Ok((ply, CutRead::default()))
}

/// Grippers along u and v.
pub(super) fn grid(ply: &Located<PlyTable>, document: &Document) -> Result<Grid, Error> {
    let Some(Located { value: Fixed([nu, nv]), .. }) = &ply.value.grippers else {
        return Err(missing("grippers", ply, document));
    };
    Ok(Grid { nu: gripper_count(nu, 2, "u", document)?, nv: gripper_count(nv, 1, "v", document)? })
}

/// A key that the table of the ply lacks.
pub(super) fn missing(key: &str, ply: &Located<PlyTable>, document: &Document) -> Error {
    let text = document.text.get(ply.span.clone()).unwrap_or_default();
    let header = text.find('\n').unwrap_or(text.len());
    document.error(
        ply.span.start..ply.span.start + header,
        format!("the key `{key}` is missing in [ply]"),
        hint(key),
    )
}

fn gripper_count(
    count: &Located<Count>,
    least: i128,
    along: &str,
    document: &Document,
) -> Result<usize, Error> {
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
    /// Angle from the direction that headings are given of to u (rad).
    pub turn: f64,
    pub mold: Option<&'a Mold>,
    /// Depth in the mold that still counts as touching it (m).
    pub tolerance: f64,
    pub document: &'a Document,
}

impl Surroundings<'_> {
    /// Refuses a drape of this many steps if its result would be too large; `span` is what the scene says of that.
    pub fn fits(&self, span: &Range<usize>, steps: usize) -> Result<(), Error> {
        self.allowed(span, size::drape(self.ply, steps))
    }

    fn allowed(&self, span: &Range<usize>, size: Result<(), Error>) -> Result<(), Error> {
        size.map_err(|fault| self.document.error(span.clone(), fault.to_string(), fault.help()))
    }

    fn motion(&self, file: &SceneKeys, target: Option<&Target>) -> Result<Motion, Error> {
        let &Surroundings { ply, document, .. } = self;
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
            let (motion, start) = trajectory(table, ply, document)?;
            start::check(&start, self)?;
            return Ok(motion);
        }
        let start = match (&file.grippers, target.and_then(|target| target.drape.as_ref())) {
            (None, Some(net)) => start::above(net, file.grippers_span(), self),
            (Some(table), Some(net)) if start::is_open(&table.value) => {
                start::above(net, &table.span, self)
            }
            (Some(table), _) => start::start(table, self, target)?,
            (None, None) => {
                return Err(document.error(
                    file.grippers_span().clone(),
                    "the scene does not say where the grippers start",
                    "add [grippers] with spacing = [\"98 mm\", \"98 mm\"] and height = \"75 mm\", or with `positions`; or a [target] to start above",
                ));
            }
        };
        start::check(&start, self)?;
        if let Some(steps) = file.motion.as_ref().and_then(|table| table.value.steps.as_ref()) {
            // before all of these positions are made
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
