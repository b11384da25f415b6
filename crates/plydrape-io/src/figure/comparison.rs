//! How the strategies of a comparison end: small multiples in one view, one frame and one scale of colors.

use super::axes::{self, Frame, ROOM, plain};
use super::bar::bar;
use super::canvas::{self, Canvas, Px};
use super::layout::{
    HEAD, LEGEND, PANELS, WIDTH, colour_name, heading, legend, shown, stage, title,
};
use super::panel::Stage;
use super::projection::{Point, View};
use super::sheet::SheetPicture;
use crate::OutputError;
use crate::strategy::Row;
use crate::table;
use plydrape::outcome::Step;

/// Panels beside each other.
const COLUMNS: usize = 2;
/// Height of a panel's two lines of title, and most height of its box (picture points).
const TITLE: f64 = 38.0;
const HEIGHT: f64 = 230.0;
/// Most characters of the second line of a panel's title.
const LONGEST: usize = 58;

/// The end of a drape, as it is drawn.
struct End<'a> {
    row: &'a Row,
    step: &'a Step,
    sheet: Option<SheetPicture>,
}

/// The picture of all strategies as an SVG 900 points wide; one that was not draped has its title alone.
///
/// # Errors
/// [`OutputError`] if the states of a sheet cannot be read or the picture cannot be drawn.
pub fn svg(name: &str, rows: &[Row]) -> Result<String, OutputError> {
    let ends: Vec<Option<End>> = rows.iter().map(end).collect::<Result<_, _>>()?;
    let drawn: Vec<&End> = ends.iter().flatten().collect();
    let points: Vec<Point> = drawn.iter().flat_map(|end| end.points()).collect();
    let of_sheet = drawn.iter().find_map(|end| end.sheet.as_ref()?.scale());
    let first = drawn.first().and_then(|end| end.row.result.as_ref());
    let mut stage = first.map(|result| stage(result, &points, of_sheet, rows.len()));

    // one scale for all panels
    let column = PANELS / COLUMNS as f64;
    let view = stage.as_ref().map(|stage| {
        let Frame { low, high, stretch } = stage.frame;
        let unit = View::of(low, high, stretch);
        let [from, to] = unit.extent(low, high);
        let size = [to[0] - from[0], to[1] - from[1]];
        let scale = ((column - ROOM[0] - ROOM[2]) / size[0]).min(HEIGHT / size[1]);
        (unit, from, size.map(|side| side * scale), scale)
    });
    let tall = view.as_ref().map_or(0.0, |(.., [_, tall], _)| ROOM[1] + tall + ROOM[3]);
    let panel = TITLE + tall;
    let height = HEAD + panel * rows.len().div_ceil(COLUMNS) as f64 + LEGEND;
    let size = [WIDTH, height.ceil()];

    let mut text = String::new();
    let mut canvas = Canvas::new(&mut text, size)?;
    canvas.text(&title(&format!("{name}, by strategy")), [28.0, 26.0], heading(17.0))?;
    for (k, (row, end)) in rows.iter().zip(ends).enumerate() {
        let corner = [(k % COLUMNS) as f64 * column, HEAD + panel * (k / COLUMNS) as f64];
        head(&mut canvas, row, corner)?;
        let Some((End { step, sheet, .. }, (unit, from, [wide, _], scale))) = end.zip(view) else {
            continue;
        };
        let (Some(stage), Some(result)) = (&mut stage, &row.result) else { continue };
        (stage.result, stage.sheet) = (result, sheet);
        let left = corner[0] + ROOM[0] + (column - ROOM[0] - ROOM[2] - wide) / 2.0;
        let place = [left, corner[1] + TITLE + ROOM[1]];
        let origin: Px = [place[0] - scale * from[0], place[1] - scale * from[1]];
        stage.draw(&mut canvas, &unit.placed(scale, origin), step)?;
    }
    if let Some(stage) = &stage {
        key(&mut canvas, stage, rows, size)?;
    }
    canvas.finish()?;
    Ok(canvas::at_size(&text, size))
}

/// The end of a strategy's drape; none of one that was not draped.
fn end(row: &Row) -> Result<Option<End<'_>>, OutputError> {
    let Some(result) = &row.result else { return Ok(None) };
    let Some(step) = result.steps.last() else { return Ok(None) };
    let sheet = SheetPicture::read(result, &[step.step])?;
    Ok(Some(End { row, step, sheet }))
}

impl End<'_> {
    /// Its points (m).
    fn points(&self) -> Vec<Point> {
        let result = self.row.result.as_ref();
        result.map_or_else(Vec::new, |result| shown(result, &[self.step], self.sheet.as_ref()))
    }
}

/// The name of a strategy, and its verdict below.
fn head(canvas: &mut Canvas, row: &Row, [x, y]: Px) -> Result<(), OutputError> {
    let name = format!("{} — {}", row.strategy, table::verdict_on(row));
    canvas.text(&name, [x + 28.0, y + 12.0], heading(14.0))?;
    let closest = || {
        let closest = table::closest(&row.limits).filter(|_| row.accepted)?;
        Some(format!("closest to its limit: {}", table::measure_text(closest)))
    };
    let broken = row.broken.first().map(table::measure_text);
    let why = broken.or_else(|| row.note.clone()).or_else(closest).unwrap_or_default();
    canvas.text(&crate::shown::excerpt(&why, LONGEST), [x + 28.0, y + 30.0], plain(12.5, -1))?;
    Ok(())
}

/// Color bar, legend, and by how much z is exaggerated.
fn key(
    canvas: &mut Canvas,
    stage: &Stage,
    rows: &[Row],
    [_, height]: Px,
) -> Result<(), OutputError> {
    let between = [HEAD + 40.0, height - LEGEND - 24.0];
    bar(canvas, colour_name(stage), stage.scale.times(1e3), PANELS + 24.0, between)?;
    let results = rows.iter().filter_map(|row| row.result.as_ref());
    let steps: Vec<&Step> = results.filter_map(|result| result.steps.last()).collect();
    let y = height - LEGEND / 2.0 - 4.0;
    legend(canvas, stage, &steps, y)?;
    if stage.frame.stretch != 1.0 {
        let note = format!("z exaggerated {} ×", axes::label(stage.frame.stretch));
        canvas.text(&note, [PANELS, y], plain(12.5, 1))?;
    }
    Ok(())
}
