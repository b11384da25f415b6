//! The flat pattern as PDF, one page at full size: a millimeter of the ply is a millimeter of the page.
//!
//! The page is as large as the pattern and its margins. A PDF page of more than 200 inches has a unit of its own, which PDF 1.6
//! and newer know. A bar of 100 mm shows whether the page was printed at full size.

use super::{Pattern, arrow, bounds, one_line};
use pdf_writer::{Content, Name, Pdf, Rect, Ref, Str, TextStr};

/// Points of PDF in a meter.
const POINTS: f64 = 72.0 / 0.0254;
/// Margin around the pattern (mm), with room for the title above and the bar below.
const MARGIN: f64 = 25.0;
/// Length of the bar (mm).
const BAR: f64 = 100.0;
/// Longest side of a page in its unit (points), by ISO 32000-1, annex C.
const LONGEST: f64 = 14_400.0;
/// The font on the page, one of the 14 that every reader has.
const FONT: Name<'static> = Name(b"F1");
/// Width of the letters of Helvetica, on average, and height of its capital letters, as shares of its size.
const WIDTH: f64 = 0.55;
const CAPITAL: f64 = 0.72;
/// A share of the radius that makes four Bézier curves a circle.
const CIRCLE: f64 = 0.552_284_75;

/// The page as a PDF file. Same pattern, same bytes.
#[must_use]
pub fn bytes(pattern: &Pattern) -> Vec<u8> {
    let page = Page::new(pattern);
    let [catalog, pages, id, font, contents, info] = [1, 2, 3, 4, 5, 6].map(Ref::new);
    let content = page.content(pattern);
    let mut pdf = Pdf::new();
    pdf.set_version(1, 7);
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([id]).count(1);
    let mut sheet = pdf.page(id);
    let [width, height] = page.size.map(|mm| (mm * page.scale) as f32);
    sheet.media_box(Rect::new(0.0, 0.0, width, height)).parent(pages).contents(contents);
    if page.unit > 1.0 {
        sheet.user_unit(page.unit as f32);
    }
    sheet.resources().fonts().pair(FONT, font);
    drop(sheet);
    pdf.type1_font(font)
        .base_font(Name(b"Helvetica"))
        .encoding_predefined(Name(b"WinAnsiEncoding"));
    pdf.stream(contents, &content);
    pdf.document_info(info)
        .title(TextStr(&one_line(pattern.title)))
        .producer(TextStr(crate::PROGRAM));
    pdf.finish()
}

/// A page and the position of the pattern on it.
struct Page {
    /// Width and height (mm).
    size: [f64; 2],
    /// Units of the page in a millimeter.
    scale: f64,
    /// Points in a unit of the page.
    unit: f64,
    /// Where the lower left corner of the page is in the drawing (mm).
    corner: [f64; 2],
}

impl Page {
    fn new(pattern: &Pattern) -> Self {
        let [low, high] = bounds(pattern).map(|corner| corner.map(|c| c * 1e3));
        let mut size = [0, 1].map(|n| high[n] - low[n] + 2.0 * MARGIN);
        // the bar fits under a small ply too
        let wider = (BAR + 2.0 * MARGIN - size[0]).max(0.0);
        size[0] += wider;
        let longest = size[0].max(size[1]) * 1e-3 * POINTS;
        let unit = (longest / LONGEST).max(1.0).ceil();
        let corner = [low[0] - MARGIN - 0.5 * wider, low[1] - MARGIN];
        Page { size, scale: 1e-3 * POINTS / unit, unit, corner }
    }

    fn content(&self, pattern: &Pattern) -> Vec<u8> {
        // boundary and holes of the ply, in red
        let mut to = Content::new();
        to.set_stroke_rgb(0.8, 0.0, 0.0);
        self.stroke(&mut to, 0.25);
        for ring in pattern.outline.rings() {
            self.path(&mut to, ring.iter().map(|p| self.on_page(*p)));
            to.close_path().stroke();
        }

        // pads of the grippers, in green
        to.set_stroke_rgb(0.0, 0.4, 0.0).set_fill_rgb(0.0, 0.4, 0.0);
        for gripper in pattern.grippers {
            let (middle, radius) = (self.on_page(gripper.place), gripper.radius * 1e3);
            self.circle(&mut to, middle, radius);
            self.cross(&mut to, middle);
            let beside = [middle[0] + radius.max(1.5) + 1.0, middle[1] + 1.0];
            self.text(&mut to, beside, 3.5, &gripper.name);
        }

        // the warp direction, in blue
        to.set_stroke_rgb(0.0, 0.0, 0.6).set_fill_rgb(0.0, 0.0, 0.6);
        self.stroke(&mut to, 0.5);
        for line in arrow(pattern) {
            self.path(&mut to, line.iter().map(|p| self.on_page(*p)));
            to.stroke();
        }
        let [line, _] = arrow(pattern);
        let tip = self.on_page(line[0]);
        self.text(&mut to, [tip[0] + 2.0, tip[1] + 2.0], 4.0, "warp");

        // a bar to measure on the print
        to.set_stroke_gray(0.0).set_fill_gray(0.0);
        self.stroke(&mut to, 0.25);
        let (left, low) = (MARGIN, 0.4 * MARGIN);
        for part in [
            [[left, low], [left + BAR, low]],
            [[left, low - 2.0], [left, low + 2.0]],
            [[left + BAR, low - 2.0], [left + BAR, low + 2.0]],
        ] {
            self.path(&mut to, part.into_iter());
            to.stroke();
        }
        self.text(&mut to, [left + 2.0, low + 1.5], 3.5, "100 mm");

        // the title, as large as the width of the page allows
        let room =
            (self.size[0] - 2.0 * MARGIN) / one_line(pattern.title).chars().count().max(1) as f64;
        let height = (CAPITAL * room / WIDTH).min(5.0);
        self.text(&mut to, [MARGIN, self.size[1] - 0.6 * MARGIN], height, pattern.title);

        to.finish().to_vec()
    }

    /// A point of the drawing (m) on the page (mm).
    fn on_page(&self, point: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|n| point[n] * 1e3 - self.corner[n])
    }

    /// A length (mm) in units of the page.
    fn units(&self, mm: f64) -> f32 {
        (mm * self.scale) as f32
    }

    /// The width of the lines that follow (mm).
    fn stroke(&self, to: &mut Content, width: f64) {
        to.set_line_width(self.units(width));
    }

    fn path(&self, to: &mut Content, points: impl Iterator<Item = [f64; 2]>) {
        for (n, point) in points.enumerate() {
            let [x, y] = point.map(|c| self.units(c));
            if n == 0 {
                to.move_to(x, y);
            } else {
                to.line_to(x, y);
            }
        }
    }

    fn circle(&self, to: &mut Content, [x, y]: [f64; 2], radius: f64) {
        let on_circle = |u: f64, v: f64| [x + u * radius, y + v * radius].map(|c| self.units(c));
        let [begin_x, begin_y] = on_circle(1.0, 0.0);
        to.move_to(begin_x, begin_y);
        // from one quarter to the next
        for [u, v] in [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]] {
            let [a, b] = on_circle(u - CIRCLE * v, v + CIRCLE * u);
            let [c, d] = on_circle(-v + CIRCLE * u, u + CIRCLE * v);
            let [e, f] = on_circle(-v, u);
            to.cubic_to(a, b, c, d, e, f);
        }
        to.close_path().stroke();
    }

    /// The middle of a gripper.
    fn cross(&self, to: &mut Content, [x, y]: [f64; 2]) {
        for part in [[[x - 1.5, y], [x + 1.5, y]], [[x, y - 1.5], [x, y + 1.5]]] {
            self.path(to, part.into_iter());
            to.stroke();
        }
    }

    /// Text with its left end on a place, its capital letters of a height (mm).
    fn text(&self, to: &mut Content, [x, y]: [f64; 2], height: f64, text: &str) {
        to.begin_text().set_font(FONT, self.units(height / CAPITAL));
        to.next_line(self.units(x), self.units(y)).show(Str(&latin(text))).end_text();
    }
}

/// A text in the encoding of the font; what it lacks becomes a question mark.
fn latin(text: &str) -> Vec<u8> {
    let letter = |c: char| match c {
        '–' => 0x96,
        '—' => 0x97,
        '…' => 0x85,
        '€' => 0x80,
        '−' => b'-',
        ' '..='~' | '\u{a0}'..='ÿ' => c as u8,
        _ => b'?',
    };
    one_line(text).chars().map(letter).collect()
}
