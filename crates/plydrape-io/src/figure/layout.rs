//! The page: title, panels one above the other, color bar, legend.

use super::axes::{self, Frame, ROOM, plain};
use super::bar::bar;
use super::canvas::{self, Canvas, Px, Type};
use super::colour::{BLACK, DARK, RED, TARGET};
use super::panel::{MOST_MARK, MoldPicture, Stage, colour_value, curved, gripper_radius};
use super::projection::{Point, View};
use super::relief::Relief;
use super::scale::Scale;
use super::sheet::SheetPicture;
use super::{FigureError, points};
use crate::result::{ResultFile, catenaries};
use crate::sheet::SheetState;
use plydrape::measure::Name;
use plydrape::mold::Mold;
use plydrape::outcome::Step;

/// Width of the sheet (picture points).
pub(super) const WIDTH: f64 = 900.0;
/// Where the panels end and the color bar begins (picture points).
pub(super) const PANELS: f64 = 800.0;
/// Most height of a box on the sheet, of one panel and of one of several (picture points).
const HEIGHT: [f64; 2] = [430.0, 285.0];
/// Height of the head line, of a panel's title and of the legend (picture points).
pub(super) const HEAD: f64 = 46.0;
const TITLE: f64 = 20.0;
pub(super) const LEGEND: f64 = 42.0;
/// How far a curved mold is drawn beyond the ply, and at most below and above it, as shares of the width.
const MARGIN: f64 = 0.1;
const DEEP: f64 = 0.35;
/// Gap up to which the ply counts as touching in a picture (m): the low end of its colors.
const TOUCHING: f64 = 1e-4;

/// Draws the whole page.
pub(super) fn page(
    result: &ResultFile,
    steps: &[&Step],
    sheet: Option<SheetPicture>,
) -> Result<String, FigureError> {
    let shown = shown(result, steps, sheet.as_ref());
    let of_sheet = sheet.as_ref().and_then(SheetPicture::scale);
    let stage = Stage { sheet, ..stage(result, &shown, of_sheet, steps.len()) };
    let Frame { low, high, stretch } = stage.frame;

    // One scale for all panels: as large as width and height allow.
    let unit = View::of(low, high, stretch);
    let [from, to] = unit.extent(low, high);
    let (wide, tall) = (to[0] - from[0], to[1] - from[1]);
    let most = HEIGHT[usize::from(steps.len() > 1)];
    let scale = ((PANELS - ROOM[0] - ROOM[2]) / wide).min(most / tall);
    let panel = TITLE + ROOM[1] + tall * scale + ROOM[3];
    let size = [WIDTH, (HEAD + panel * steps.len() as f64 + LEGEND).ceil()];

    let mut text = String::new();
    let mut canvas = Canvas::new(&mut text, size)?;
    let planned = if result.plan.is_some() { ", planned" } else { "" };
    canvas.text(
        &title(&format!("{}{planned}", result.scene.title)),
        [28.0, 26.0],
        heading(17.0),
    )?;
    let free = PANELS - ROOM[0] - ROOM[2] - wide * scale;
    for (k, step) in steps.iter().enumerate() {
        let top = HEAD + panel * k as f64;
        canvas.text(&caption(&stage, step), [28.0, top + 12.0], heading(14.0))?;
        let corner = [ROOM[0] + free / 2.0, top + TITLE + ROOM[1]];
        let origin = [corner[0] - scale * from[0], corner[1] - scale * from[1]];
        stage.draw(&mut canvas, &unit.placed(scale, origin), step)?;
    }
    // Lines alone carry no colour of height.
    if result.scene.ply.lines().surface().cells() > 0 || stage.sheet.is_some() {
        let between = [HEAD + 40.0, size[1] - LEGEND - 24.0];
        bar(&mut canvas, colour_name(&stage), stage.scale.times(1e3), PANELS + 24.0, between)?;
    }
    legend(&mut canvas, &stage, steps, size[1] - LEGEND / 2.0 - 4.0)?;
    canvas.finish()?;
    Ok(canvas::at_size(&text, size))
}

/// What the colors tell.
pub(super) fn colour_name(stage: &Stage) -> &'static str {
    match stage.is_over_mold() {
        true => "height (mm)",
        false if curved(stage.result).is_some() => "gap (mm)",
        false => "z (mm)",
    }
}

pub(super) fn heading(size: f64) -> Type {
    Type { size, bold: true, ink: DARK, side: -1 }
}

/// A title, cut to the width of the sheet.
pub(super) fn title(title: &str) -> String {
    if title.chars().count() <= 80 {
        return title.to_owned();
    }
    title.chars().take(79).chain(['…']).collect()
}

/// `Step 26 — first contact`.
fn caption(stage: &Stage, step: &Step) -> String {
    let (result, stretch) = (stage.result, stage.frame.stretch);
    let number = step.step;
    let contact = result.summary.first_contact_step();
    let what = if contact == Some(number) {
        " — first contact"
    } else if result.steps.len() > 1 && result.steps.first().is_some_and(|s| s.step == number) {
        " — start"
    } else if result.steps.len() > 1 && result.steps.last().is_some_and(|s| s.step == number) {
        " — end"
    } else {
        ""
    };
    let note = match stretch {
        1.0 => String::new(),
        more => format!("  (z exaggerated {} ×)", axes::label(more)),
    };
    if let Some(highest) = stage.sheet.as_ref().and_then(|sheet| sheet.highest(number)) {
        let over = axes::label((highest * 1e4).round() / 10.0);
        return format!("Step {number}{what}{note}  (up to {over} mm over the mold)");
    }
    let gap = match (curved(result), step.measures.get(Name::Gap)) {
        (Some(_), Some(gap)) => format!("  (gap to the mold up to {:.1} mm)", gap.value),
        _ => String::new(),
    };
    format!("Step {number}{what}{note}{gap}")
}

/// The points of some steps that a figure shows (m), of the sheet where there is one.
pub(super) fn shown(
    result: &ResultFile,
    steps: &[&Step],
    sheet: Option<&SheetPicture>,
) -> Vec<Point> {
    match sheet {
        Some(sheet) => {
            let places =
                |state: &SheetState| [state.positions.to_vec(), state.grippers.to_vec()].concat();
            sheet.states.iter().flat_map(places).collect()
        }
        None => steps.iter().flat_map(|s| points(result, s)).collect(),
    }
}

/// Box, color scale and mold patch that hold all shown points; `of_sheet` is the scale of a sheet, if one is shown.
pub(super) fn stage<'a>(
    result: &'a ResultFile,
    shown: &[Point],
    of_sheet: Option<Scale>,
    panels: usize,
) -> Stage<'a> {
    let [bottom, top] = bounds(shown);
    let scale = of_sheet.unwrap_or_else(|| match curved(result) {
        None if top[2] - bottom[2] < 1e-5 => Scale::Even([bottom[2] - 5e-4, top[2] + 5e-4]),
        None => Scale::Even([bottom[2], top[2]]),
        Some(_) => {
            let most =
                shown.iter().map(|p| colour_value(result, *p)).fold(10.0 * TOUCHING, f64::max);
            Scale::Orders([TOUCHING, most])
        }
    });
    let finite = |p: &&Point| p.iter().all(|c| c.is_finite() && c.abs() < 1e6);
    let target = result.scene.target_grippers().into_iter().flatten().filter(finite);
    let all: Vec<Point> = shown.iter().chain(target).copied().collect();
    let [mut low, mut high] = bounds(&all);

    // Discs reach beyond the grippers; the mold reaches to the walls.
    let mut reach = 1.35 * gripper_radius(result);
    if curved(result).is_some() {
        reach = reach.max(MARGIN * (high[0] - low[0]).hypot(high[1] - low[1]));
    }
    for c in 0..2 {
        low[c] -= reach;
        high[c] += reach;
    }
    let across = (high[0] - low[0]).hypot(high[1] - low[1]);
    let mold = result.scene.mold.as_ref().and_then(|mold| mold_picture(mold, low, high, across));
    if let Some([floor, roof]) = mold.as_ref().map(MoldPicture::heights) {
        low[2] = low[2].min(floor);
        high[2] = high[2].max(roof);
    }
    high[2] += 0.2 * reach;
    let least = 0.05 * across;
    if high[2] - low[2] < least {
        low[2] = (low[2] + high[2] - least) / 2.0;
        high[2] = low[2] + least;
    }
    let stretch = match curved(result) {
        None => exaggeration(high[2] - low[2], across, top[2] - bottom[2]),
        Some(_) => 1.0,
    };
    Stage { result, frame: Frame { low, high, stretch }, panels, scale, mold, sheet: None }
}

/// Lowest and highest coordinates of some points.
pub(super) fn bounds(points: &[Point]) -> [Point; 2] {
    let by = |pick: fn(f64, f64) -> f64, start: f64| {
        [0, 1, 2].map(|c| points.iter().map(|p| p[c]).fold(start, pick))
    };
    [by(f64::min, f64::INFINITY), by(f64::max, f64::NEG_INFINITY)]
}

/// A round factor that lifts a flat box to about a seventh of its width; 1 where it is high enough.
fn exaggeration(height: f64, across: f64, relief: f64) -> f64 {
    let wanted = 0.14 * across / height;
    // A ply without relief stays flat.
    if relief < 2e-3 * across {
        return 1.0;
    }
    let round = [20.0, 10.0, 5.0, 3.0, 2.0];
    round.into_iter().find(|f| *f <= wanted).unwrap_or(1.0)
}

/// The mold over the floor of the box, as far as it does not run far out of the picture.
pub(super) fn mold_picture(
    mold: &Mold,
    low: Point,
    high: Point,
    across: f64,
) -> Option<MoldPicture> {
    let Mold::Plane(plane) = mold else {
        let heights = [low[2] - DEEP * across, high[2] + DEEP * across];
        let patch = Relief::of(mold, [low[0], low[1]], [high[0], high[1]], heights);
        return patch.map(MoldPicture::Relief);
    };
    let [nx, ny, nz] = plane.normal;
    let [px, py, pz] = plane.point;
    let on = |x: f64, y: f64| [x, y, pz - (nx * (x - px) + ny * (y - py)) / nz];
    let patch =
        [on(low[0], low[1]), on(high[0], low[1]), on(high[0], high[1]), on(low[0], high[1])];
    let near = |p: &Point| p[2] > low[2] - across && p[2] < high[2] + across;
    patch.iter().all(near).then_some(MoldPicture::Flat(patch))
}

/// What the marks mean, in one line.
pub(super) fn legend(
    canvas: &mut Canvas,
    stage: &Stage,
    steps: &[&Step],
    y: f64,
) -> Result<(), FigureError> {
    let word = |canvas: &mut Canvas, text: &str, x: f64| canvas.text(text, [x, y], plain(12.5, -1));
    let mut x = 28.0;
    if stage.sheet.is_none() {
        canvas.line(&[[x, y], [x + 26.0, y]], RED, 1.7)?;
        word(canvas, "catenary", x + 34.0)?;
        x += 118.0;
    }
    let disc: Vec<Px> = (0..24)
        .map(|k| (f64::from(k) * std::f64::consts::TAU / 24.0).sin_cos())
        .map(|(s, c)| [x + 9.0 + 9.0 * c, y + 5.0 * s])
        .collect();
    canvas.polygon(&disc, BLACK)?;
    word(canvas, "gripper", x + 26.0)?;
    x += 100.0;
    let touched = |s: &&Step| catenaries(s).iter().any(|c| c.contact.is_some());
    if stage.sheet.is_none() && steps.iter().any(touched) {
        canvas.circle([x + 5.0, y], MOST_MARK, RED, 1.4)?;
        word(canvas, "contact with the mold", x + 17.0)?;
        x += 176.0;
    }
    if stage.mold.is_some() && stage.result.scene.target.is_some() {
        canvas.line(&[[x, y], [x + 26.0, y]], TARGET, 1.2)?;
        word(canvas, "target outline", x + 34.0)?;
    }
    Ok(())
}
