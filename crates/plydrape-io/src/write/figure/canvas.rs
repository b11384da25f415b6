//! The sheet: shapes and text in picture points, written as the elements of an SVG file.
//!
//! Coordinates are exact to a tenth of a point.

use super::color::DARK;
use std::fmt::Write;

/// A place on the sheet: right and down (picture points).
pub(super) type Px = [f64; 2];

/// A color and how much it covers, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ink(pub [u8; 3], pub f64);

impl Ink {
    /// The attributes that paint a shape's inside or its line, `what` is `fill` or `stroke`.
    fn attributes(self, what: &str) -> String {
        let Ink([r, g, b], cover) = self;
        let color = format!(" {what}=\"#{r:02x}{g:02x}{b:02x}\"");
        if cover < 1.0 { format!("{color} {what}-opacity=\"{cover}\"") } else { color }
    }
}

/// How a text is set.
#[derive(Debug, Clone, Copy)]
pub(super) struct Type {
    /// Size (picture points).
    pub size: f64,
    /// Bold or not.
    pub bold: bool,
    /// Color.
    pub ink: Ink,
    /// Which part of the text is at its place: −1 its left, 0 its middle, 1 its right.
    pub side: i8,
}

/// Plain dark text of a size.
pub(super) fn plain(size: f64, side: i8) -> Type {
    Type { size, bold: false, ink: DARK, side }
}

/// Bold dark text of a size that begins at its place.
pub(super) fn heading(size: f64) -> Type {
    Type { size, bold: true, ink: DARK, side: -1 }
}

/// A white sheet.
pub(super) struct Canvas {
    text: String,
}

impl Canvas {
    /// An empty sheet of a size (picture points).
    pub(super) fn new([w, h]: Px) -> Self {
        let text = format!(
            "<svg width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" role=\"img\" font-family=\"sans-serif\" \
             xmlns=\"http://www.w3.org/2000/svg\">\n"
        );
        let mut canvas = Canvas { text };
        canvas.polygon(&[[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]], Ink([255; 3], 1.0));
        canvas
    }

    /// The text of the file.
    pub(super) fn finish(self) -> String {
        self.text + "</svg>\n"
    }

    fn element(&mut self, shape: std::fmt::Arguments) {
        // writing into a text cannot fail
        let _ = writeln!(self.text, "{shape}");
    }

    /// A filled polygon.
    pub(super) fn polygon(&mut self, corners: &[Px], ink: Ink) {
        self.element(format_args!("<path{} d=\"{}z\"/>", ink.attributes("fill"), path(corners)));
    }

    /// A line of a width (picture points) through points.
    pub(super) fn line(&mut self, points: &[Px], ink: Ink, width: f64) {
        let (stroke, path) = (ink.attributes("stroke"), path(points));
        self.element(format_args!(
            "<path fill=\"none\"{stroke} stroke-width=\"{width}\" d=\"{path}\"/>"
        ));
    }

    /// An open circle.
    pub(super) fn circle(&mut self, [x, y]: Px, radius: f64, ink: Ink, width: f64) {
        let stroke = ink.attributes("stroke");
        self.element(format_args!(
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"none\"{stroke} stroke-width=\"{width}\"/>"
        ));
    }

    /// A filled circle.
    pub(super) fn disc(&mut self, [x, y]: Px, radius: f64, ink: Ink) {
        let fill = ink.attributes("fill");
        self.element(format_args!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\"{fill}/>"));
    }

    /// One line of text, its middle at the height of its place; what XML cannot hold becomes a space.
    pub(super) fn text(&mut self, text: &str, [x, y]: Px, set: Type) {
        let anchor = match set.side {
            ..0 => "start",
            0 => "middle",
            1.. => "end",
        };
        let (size, fill) = (set.size, set.ink.attributes("fill"));
        let weight = if set.bold { " font-weight=\"bold\"" } else { "" };
        let text = escaped(text);
        self.element(format_args!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" dy=\"0.5ex\" text-anchor=\"{anchor}\" font-size=\"{size}\"{weight}{fill}>{text}</text>"
        ));
    }
}

/// The corners of a path, each from the origin.
fn path(points: &[Px]) -> String {
    let mut path = String::new();
    for (n, [x, y]) in points.iter().enumerate() {
        let _ = write!(path, "{}{x:.1} {y:.1}", if n == 0 { 'M' } else { 'L' });
    }
    path
}

/// A text as XML holds it.
fn escaped(text: &str) -> String {
    let clean = text.replace(|c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'), " ");
    clean.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A title may hold anything that a scene's title may hold.
    #[test]
    fn texts_are_escaped() {
        let mut canvas = Canvas::new([10.0, 10.0]);
        canvas.text("<b>&\"\u{1}</b>", [0.0, 0.0], plain(8.0, -1));
        assert!(canvas.finish().contains(">&lt;b&gt;&amp;\" &lt;/b&gt;</text>"));
    }

    /// A polygon is closed; full cover needs no attribute.
    #[test]
    fn shapes_pass_their_corners() {
        let mut canvas = Canvas::new([10.0, 10.0]);
        canvas.polygon(&[[1.0, 2.0], [3.04, 2.0], [3.0, 4.0]], Ink([255, 0, 16], 1.0));
        canvas.line(&[[1.0, 2.0], [3.0, 2.0]], Ink([0; 3], 0.5), 0.8);
        let text = canvas.finish();
        assert!(text.contains("<path fill=\"#ff0010\" d=\"M1.0 2.0L3.0 2.0L3.0 4.0z\"/>"));
        assert!(text.contains(
            "<path fill=\"none\" stroke=\"#000000\" stroke-opacity=\"0.5\" stroke-width=\"0.8\" d=\"M1.0 2.0L3.0 2.0\"/>"
        ));
    }
}
