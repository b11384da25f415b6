//! The sheet: shapes and text in picture points, through the SVG writer of `plotters`.
//!
//! `plotters` counts in whole pixels. The sheet is therefore drawn ten times as large, and the view box
//! of the file brings it back: coordinates are exact to a tenth of a point.

use super::FigureError;
use super::shorten::shortened;
use plotters::backend::DrawingBackend;
use plotters::prelude::{IntoFont, RGBAColor, SVGBackend, ShapeStyle};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle, RGBColor};

/// Fine steps of the drawing in one picture point.
const FINE: f64 = 10.0;
/// The factor between a font size asked of `plotters` and the one it writes.
const FONT: f64 = 1.24;

/// A place on the sheet: right and down (picture points).
pub(super) type Px = [f64; 2];

/// A color and how much it covers, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ink(pub [u8; 3], pub f64);

impl Ink {
    fn rgba(self) -> RGBAColor {
        let Ink([r, g, b], cover) = self;
        RGBColor(r, g, b).mix(cover)
    }
}

/// How a text is set.
#[derive(Debug, Clone, Copy)]
pub(super) struct Type {
    /// Size (picture points).
    pub size: f64,
    /// Bold or not.
    pub bold: bool,
    /// Colour.
    pub ink: Ink,
    /// What of the text stands at its place: −1 its left, 0 its middle, 1 its right.
    pub side: i8,
}

/// A white sheet.
pub(super) struct Canvas<'a> {
    backend: SVGBackend<'a>,
}

impl<'a> Canvas<'a> {
    /// An empty sheet of a size (picture points) that writes into `text`.
    pub(super) fn new(text: &'a mut String, size: Px) -> Result<Self, FigureError> {
        let fine = size.map(|s| (s * FINE).round() as u32);
        let mut canvas = Canvas { backend: SVGBackend::with_string(text, (fine[0], fine[1])) };
        let [w, h] = size;
        canvas.polygon(&[[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]], Ink([255; 3], 1.0))?;
        Ok(canvas)
    }

    /// Closes the file.
    pub(super) fn finish(mut self) -> Result<(), FigureError> {
        self.backend.present().map_err(fault)
    }

    /// A filled polygon.
    pub(super) fn polygon(&mut self, corners: &[Px], ink: Ink) -> Result<(), FigureError> {
        let path = corners.iter().map(|p| fine(*p));
        self.backend.fill_polygon(path, &style(ink, 0.0)).map_err(fault)
    }

    /// A line of a width (picture points) through points.
    pub(super) fn line(&mut self, points: &[Px], ink: Ink, width: f64) -> Result<(), FigureError> {
        let path = points.iter().map(|p| fine(*p));
        self.backend.draw_path(path, &style(ink, width)).map_err(fault)
    }

    /// An open circle.
    pub(super) fn circle(
        &mut self,
        center: Px,
        radius: f64,
        ink: Ink,
        width: f64,
    ) -> Result<(), FigureError> {
        let radius = (radius * FINE).round() as u32;
        self.backend.draw_circle(fine(center), radius, &style(ink, width), false).map_err(fault)
    }

    /// One line of text, its middle at the height of its place; control characters become spaces.
    pub(super) fn text(&mut self, text: &str, at: Px, set: Type) -> Result<(), FigureError> {
        let side = match set.side {
            ..0 => HPos::Left,
            0 => HPos::Center,
            1.. => HPos::Right,
        };
        let weight = if set.bold { FontStyle::Bold } else { FontStyle::Normal };
        let font =
            ("sans-serif", set.size * FINE * FONT).into_font().style(weight).color(&set.ink.rgba());
        let clean = text.replace(|c: char| c.is_control(), " ");
        self.backend
            .draw_text(&clean, &font.pos(Pos::new(side, VPos::Center)), fine(at))
            .map_err(fault)
    }
}

/// The file as it should be shown: a tenth of the fine size, with a role for those who cannot see it.
pub(super) fn at_size(text: &str, size: Px) -> String {
    let [w, h] = size.map(|s| (s * FINE).round() as u32);
    let drawn = format!("width=\"{w}\" height=\"{h}\"");
    let shown = format!("width=\"{}\" height=\"{}\" role=\"img\"", size[0], size[1]);
    // Full cover is what an SVG has by itself; texts cannot hold this, their quotes are escaped.
    shortened(&text.replacen(&drawn, &shown, 1).replace(" opacity=\"1\"", ""))
}

fn fine(p: Px) -> (i32, i32) {
    ((p[0] * FINE).round() as i32, (p[1] * FINE).round() as i32)
}

fn style(ink: Ink, width: f64) -> ShapeStyle {
    ShapeStyle {
        color: ink.rgba(),
        filled: width == 0.0,
        stroke_width: (width * FINE).round() as u32,
    }
}

fn fault(cause: impl std::fmt::Display) -> FigureError {
    FigureError::Drawing(cause.to_string())
}
