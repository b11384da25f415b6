//! The box around the ply: back walls with a grid, ticks in mm along its front edges, labels.

use super::FigureError;
use super::canvas::{Canvas, Px, Type};
use super::colour::{DARK, FRAME, GRID};
use super::projection::{Point, View};

/// Size of tick labels (picture points).
pub(super) const TICK: f64 = 11.5;
/// Size of axis labels (picture points).
pub(super) const LABEL: f64 = 12.5;
/// Room that ticks and labels need around the projected box: left, top, right, bottom (picture points).
pub(super) const ROOM: [f64; 4] = [54.0, 26.0, 74.0, 52.0];

/// Plain text of a size.
pub(super) fn plain(size: f64, side: i8) -> Type {
    Type { size, bold: false, ink: DARK, side }
}

/// A box in space (m) and the exaggeration of its height.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub low: Point,
    pub high: Point,
    pub stretch: f64,
}

/// Round numbers (mm) within a range (m), at most so many intervals.
pub(super) fn ticks(low: f64, high: f64, most: f64) -> Vec<f64> {
    round(low * 1e3, high * 1e3, most)
}

/// Round numbers within a range, at most so many intervals.
pub(super) fn round(low: f64, high: f64, most: f64) -> Vec<f64> {
    let raw = (high - low) / most.max(1.0);
    if !raw.is_finite() || raw <= 0.0 {
        return Vec::new();
    }
    let ten = 10f64.powf(raw.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|m| m * ten);
    let step = steps.into_iter().find(|s| *s >= raw * 0.999).unwrap_or(10.0 * ten);
    let (first, last) = ((low / step - 1e-6).ceil(), (high / step + 1e-6).floor());
    if !(first.abs() < 1e12 && last - first < 1e3) {
        return Vec::new();
    }
    (first as i64..=last as i64).map(|k| k as f64 * step).collect()
}

/// A tick's text: no more digits than the tick needs.
pub(super) fn label(value: f64) -> String {
    let digits = (0..6).find(|d| {
        let shift = 10f64.powi(*d);
        (value * shift - (value * shift).round()).abs() < 1e-6 * shift.max(1.0)
    });
    let text = format!("{value:.*}", digits.unwrap_or(6) as usize);
    if text == "-0" { "0".into() } else { text.replace('-', "−") }
}

impl Frame {
    /// Ticks of the three axes (mm), as many as their length on the sheet has room for.
    fn ticks(&self, view: &View) -> [Vec<f64>; 3] {
        [0, 1, 2].map(|axis| {
            let mut end = self.low;
            end[axis] = self.high[axis];
            let ([ax, ay], [bx, by]) = (view.at(self.low), view.at(end));
            let room = [62.0, 34.0, 28.0][axis];
            let most = ((bx - ax).hypot(by - ay) / room).floor().clamp(2.0, 10.0);
            let found = ticks(self.low[axis], self.high[axis], most);
            // a lone tick gives no scale
            if found.len() > 1 { found } else { ticks(self.low[axis], self.high[axis], 2.0 * most) }
        })
    }

    /// Floor and back walls with their grid lines.
    pub(super) fn back(&self, canvas: &mut Canvas, view: &View) -> Result<(), FigureError> {
        let ([x0, y0, z0], [x1, y1, z1]) = (self.low, self.high);
        let [xs, ys, zs] =
            self.ticks(view).map(|t| t.into_iter().map(|v| v * 1e-3).collect::<Vec<_>>());
        let mut rule = |points: &[Point], ink| {
            let path: Vec<Px> = points.iter().map(|p| view.at(*p)).collect();
            canvas.line(&path, ink, 0.8)
        };
        for x in xs {
            rule(&[[x, y0, z0], [x, y1, z0], [x, y1, z1]], GRID)?;
        }
        for y in ys {
            rule(&[[x1, y, z0], [x0, y, z0], [x0, y, z1]], GRID)?;
        }
        for z in zs {
            rule(&[[x0, y0, z], [x0, y1, z], [x1, y1, z]], GRID)?;
        }
        rule(&[[x0, y0, z1], [x0, y1, z1], [x1, y1, z1], [x1, y1, z0]], GRID)?;
        rule(&[[x0, y1, z0], [x0, y1, z1]], GRID)?;
        rule(&[[x0, y0, z0], [x0, y1, z0], [x1, y1, z0]], GRID)?;
        rule(&[[x0, y0, z1], [x0, y0, z0], [x1, y0, z0], [x1, y1, z0]], FRAME)
    }

    /// Ticks and labels along the left upright edge and the two front edges of the floor.
    pub(super) fn front(&self, canvas: &mut Canvas, view: &View) -> Result<(), FigureError> {
        let ([x0, y0, z0], [x1, y1, z1]) = (self.low, self.high);
        let [xs, ys, zs] = self.ticks(view);
        let upright = |z: f64, dx: f64, dy: f64| {
            let [x, y] = view.at([x0, y0, z]);
            [x + dx, y + dy]
        };
        let corner = [x1, y0, z0];
        let along_x = Edge::of(view, [x0, y0, z0], corner);
        let along_y = Edge::of(view, corner, [x1, y1, z0]);
        for x in xs {
            along_x.text(canvas, &label(x), view.at([x * 1e-3, y0, z0]), 0)?;
        }
        for y in ys {
            along_y.text(canvas, &label(y), view.at([x1, y * 1e-3, z0]), 0)?;
        }
        for z in zs {
            canvas.text(&label(z), upright(z * 1e-3, -8.0, 0.0), plain(TICK, 1))?;
        }
        let (xm, ym) = ((x0 + x1) / 2.0, (y0 + y1) / 2.0);
        along_x.text(canvas, "x (mm)", view.at([xm, y0, z0]), 1)?;
        along_y.text(canvas, "y (mm)", view.at([x1, ym, z0]), 1)?;
        // The panel's title says by how much z is exaggerated.
        canvas.text("z (mm)", upright(z1, 0.0, -16.0), plain(LABEL, 1))
    }
}

/// A front edge of the floor on the sheet, and the direction that leads away from the box.
struct Edge {
    away: Px,
}

impl Edge {
    fn of(view: &View, from: Point, to: Point) -> Self {
        let ([ax, ay], [bx, by]) = (view.at(from), view.at(to));
        let length = (bx - ax).hypot(by - ay).max(1e-9);
        // Front edges bound the picture from below.
        let down = if bx >= ax { 1.0 } else { -1.0 };
        Edge { away: [down * (ay - by) / length, down * (bx - ax) / length] }
    }

    /// Writes beside the edge: a tick's text in row 0, the axis label in row 1.
    fn text(&self, canvas: &mut Canvas, text: &str, at: Px, row: u8) -> Result<(), FigureError> {
        let [x, y] = self.away;
        let side = match x {
            ..-0.4 => 1,
            0.4.. => -1,
            _ => 0,
        };
        let near = if side == 0 { 13.0 } else { 9.0 };
        let (reach, size) = match row {
            0 => (near, TICK),
            _ => (near + 25.0, LABEL),
        };
        canvas.text(text, [at[0] + reach * x, at[1] + reach * y], plain(size, side))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ticks are round numbers inside the range; their texts carry no digits in vain.
    #[test]
    fn ticks_are_round() {
        assert_eq!(ticks(-0.012, 0.078, 4.0), [0.0, 50.0]);
        assert_eq!(ticks(0.0, 0.3, 6.0), [0.0, 50.0, 100.0, 150.0, 200.0, 250.0, 300.0]);
        assert_eq!(ticks(0.0, 0.0, 6.0), Vec::<f64>::new());
        assert_eq!([0.0, -50.0, 0.25, 1e-3 * 30.0].map(label), ["0", "−50", "0.25", "0.03"]);
    }
}
