//! What can be wrong with a drawing of a ply.

use crate::store::size::SizeError;
use plydrape::ply::OutlineError;

/// Why a drawing is no outline of a ply, with the name of its file.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {fault}")]
pub struct OutlineFileError {
    /// The file.
    pub file: String,
    /// What is wrong with it.
    pub fault: OutlineFault,
}

/// A curve of a drawing, for messages: what it is, its layer, and a point of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// Its type, as DXF names it.
    pub entity: &'static str,
    /// Its layer.
    pub layer: String,
    /// A point of it (m).
    pub at: [f64; 2],
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Place { entity, layer, at } = self;
        write!(f, "{entity} on layer `{}` at {}", layer.escape_debug(), mm(*at))
    }
}

/// Why a drawing is no outline of a ply. Lines of the file count from 1, places are in meters.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineFault {
    /// The file cannot be opened or read.
    #[error("cannot be read: {0}")]
    Unreadable(std::io::Error),
    /// It is a drawing, but not a DXF text.
    #[error("it is {0}, not a DXF text")]
    Format(&'static str),
    /// It would not fit the memory that is allowed.
    #[error(transparent)]
    Size(SizeError),
    /// Every second line of a DXF text is the code of the line that follows.
    #[error("line {line}: found `{found}`, expected a group code, which is a whole number")]
    Code {
        /// The line.
        line: usize,
        /// What stands there.
        found: String,
    },
    /// The file stops before its mark of the end.
    #[error("the file ends at line {line} without its mark EOF")]
    Ends {
        /// Its last line.
        line: usize,
    },
    /// A value is not what its group code asks for.
    #[error("line {line}: group code {code} cannot be {found:?}")]
    Value {
        /// The line.
        line: usize,
        /// The code.
        code: String,
        /// The value.
        found: String,
    },
    /// The library refuses the file without a line.
    #[error("it is no complete DXF text: {0}")]
    Unread(String),
    /// Its header gives no unit of length.
    #[error("its header gives no unit of length ($INSUNITS)")]
    Unitless,
    /// A number of the options that cannot be.
    #[error("{what} is {value}, expected a number above 0")]
    Option {
        /// The option.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A layer that is not there.
    #[error("there is no layer `{}`", .layer.escape_debug())]
    Layer {
        /// The layer that is asked for.
        layer: String,
        /// The layers there are.
        known: Vec<String>,
    },
    /// Nothing that could be an outline.
    #[error("it has no lines or curves on {}", wanted(.layers.as_deref()))]
    Empty {
        /// The layers that were asked for.
        layers: Option<Vec<String>>,
        /// The layers that have curves.
        others: Vec<String>,
    },
    /// A curve in a plane that is not that of the drawing.
    #[error("{0} lies in a plane that is inclined to the drawing")]
    Tilted(Place),
    /// A curve that leaves its plane.
    #[error("{place} is not flat: its z goes from {:.3} to {:.3} mm", z[0] * 1e3, z[1] * 1e3)]
    NotFlat {
        /// The curve.
        place: Place,
        /// Lowest and highest z (m).
        z: [f64; 2],
    },
    /// A number that is none.
    #[error("{entity} on layer `{}` has a coordinate that is no finite number", .layer.escape_debug())]
    NotFinite {
        /// The type of the curve.
        entity: &'static str,
        /// Its layer.
        layer: String,
    },
    /// A spline that says what it passes through but not what it is.
    #[error("{0} has fit points and no control points")]
    FitPoints(Place),
    /// A spline whose numbers do not fit together.
    #[error("{place} is no spline: {why}")]
    Spline {
        /// The spline.
        place: Place,
        /// What is wrong.
        why: String,
    },
    /// A block that is not in the file.
    #[error("{place} places the block `{}`, which is not in the file", .block.escape_debug())]
    Block {
        /// Where it is placed.
        place: Place,
        /// The block.
        block: String,
    },
    /// Blocks within blocks without end, or too many of them.
    #[error("{place} places more than {most} {what}")]
    Blocks {
        /// Where they are placed.
        place: Place,
        /// The most there may be.
        most: usize,
        /// Of what.
        what: &'static str,
    },
    /// More points than an outline may have.
    #[error(
        "followed to {:.3} mm, its curves have more than {most} points; the last is {place}", tolerance * 1e3
    )]
    Points {
        /// The curve that had too many.
        place: Place,
        /// The tolerance (m).
        tolerance: f64,
        /// Most points.
        most: usize,
    },
    /// An end that meets no other.
    #[error(
        "{place} is not closed: it ends {:.3} mm from the nearest other open end, which is at {}", width * 1e3, mm(*next)
    )]
    Gap {
        /// The curve and its open end.
        place: Place,
        /// The nearest other open end (m).
        next: [f64; 2],
        /// Distance between the two (m).
        width: f64,
    },
    /// Three ends or more at one point.
    #[error("{count} curves end at {}, one of them {place}", mm(place.at))]
    Branch {
        /// One of the curves and its end.
        place: Place,
        /// How many ends meet.
        count: usize,
    },
    /// An outline that is hardly larger than the tolerance.
    #[error(
        "its largest closed line, {place}, is {:.4} mm by {:.4} mm, which is too small for a tolerance of {:.4} mm",
        size[0] * 1e3, size[1] * 1e3, tolerance * 1e3
    )]
    Tiny {
        /// The line.
        place: Place,
        /// Its size along x and y (m).
        size: [f64; 2],
        /// The tolerance (m).
        tolerance: f64,
    },
    /// Two outlines beside each other.
    #[error("it has two outlines: {inner} is not inside the largest closed line, {outer}")]
    Several {
        /// The largest closed line.
        outer: Place,
        /// One that is not in it.
        inner: Box<Place>,
        /// The layers with closed lines.
        layers: Vec<String>,
    },
    /// Its closed lines are no outline of a ply.
    #[error("{0}")]
    Outline(OutlineError),
}

impl OutlineFileError {
    /// What to do about it.
    #[must_use]
    pub fn remedy(&self) -> String {
        match &self.fault {
            OutlineFault::Unreadable(_) => "check its name and its permissions".into(),
            OutlineFault::Format(_) => "save the drawing as ASCII DXF".into(),
            OutlineFault::Size(source) => source.remedy().into(),
            OutlineFault::Code { .. }
            | OutlineFault::Ends { .. }
            | OutlineFault::Value { .. }
            | OutlineFault::Unread(_) => {
                "is the file complete? copy it or save it as ASCII DXF once more".into()
            }
            OutlineFault::Unitless => "state the unit of the drawing, as in unit = \"mm\"".into(),
            OutlineFault::Option { .. } => "give a number above 0".into(),
            OutlineFault::Layer { known, .. } => format!("layers are {}", listed(known)),
            OutlineFault::Empty { others, .. } if others.is_empty() => {
                "draw the outline with lines, arcs, circles, ellipses, polylines or splines".into()
            }
            OutlineFault::Empty { others, .. } => {
                format!("layers with lines or curves are {}", listed(others))
            }
            OutlineFault::Tilted(_) | OutlineFault::NotFlat { .. } => {
                "draw the outline flat, in the x-y plane".into()
            }
            OutlineFault::FitPoints(_) => {
                "save it with control points, or convert it to a polyline".into()
            }
            OutlineFault::Block { .. } | OutlineFault::Blocks { .. } => {
                "explode the block in the drawing".into()
            }
            OutlineFault::Points { .. } => "give a larger tolerance".into(),
            OutlineFault::Gap { .. } => {
                "join the ends in the drawing, or choose the layer that has the outline alone"
                    .into()
            }
            OutlineFault::Branch { .. } => {
                "remove lines that are drawn twice, or choose the layer that has the outline alone"
                    .into()
            }
            OutlineFault::Tiny { .. } => "is the unit of the drawing right?".into(),
            OutlineFault::Several { layers, .. } if layers.len() > 1 => {
                format!("choose a layer; those with closed lines are {}", listed(layers))
            }
            OutlineFault::Several { .. } => {
                "leave one ply in the drawing, or put each on a layer of its own".into()
            }
            _ => "correct the drawing".into(),
        }
    }
}

/// A place as messages show it (mm).
fn mm(at: [f64; 2]) -> String {
    format!("({:.3}, {:.3}) mm", at[0] * 1e3, at[1] * 1e3)
}

/// Layers by name; of many the first.
fn listed(layers: &[String]) -> String {
    const MOST: usize = 20;
    let names: Vec<String> =
        layers.iter().take(MOST).map(|name| format!("`{}`", name.escape_debug())).collect();
    let more = if layers.len() > MOST { ", …" } else { "" };
    format!("{}{more}", names.join(", "))
}

fn wanted(layers: Option<&[String]>) -> String {
    match layers {
        None => "its visible layers".into(),
        Some([layer]) => format!("layer `{}`", layer.escape_debug()),
        Some(layers) => format!("layers {}", listed(layers)),
    }
}
