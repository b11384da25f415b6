//! What the colors of the ply can tell.

use plydrape::measure::{Name, Verdict};
use serde::Serialize;

/// One quantity that colors tell.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Field {
    /// What the page finds its values by.
    pub key: &'static str,
    /// In a few words, for a button.
    name: &'static str,
    label: String,
    unit: &'static str,
    /// `vertex` or `cell`.
    on: &'static str,
    /// `even`, or `orders` where equal ratios are equally far apart; what lies beyond the ends has their colors.
    scale: &'static str,
    low: f64,
    high: f64,
    /// Key of the measure that is the worst of its values, if there is one.
    measure: Option<&'static str>,
    /// The limit of that measure, if the ply is judged by it.
    limit: Option<f64>,
}

impl Field {
    /// A quantity at vertices; equal differences are equally far apart in its colors.
    pub fn new(
        key: &'static str,
        name: &'static str,
        label: impl Into<String>,
        unit: &'static str,
        [low, high]: [f64; 2],
    ) -> Self {
        let label = label.into();
        let (on, scale, measure, limit) = ("vertex", "even", None, None);
        Field { key, name, label, unit, on, scale, low, high, measure, limit }
    }

    /// A quantity whose worst value is a measure, in the words of that, with its limit if it is among the judged ones.
    pub fn of_measure(
        key: &'static str,
        name: &'static str,
        measure: Name,
        judged: &[Verdict],
        ends: [f64; 2],
    ) -> Self {
        let (limit, measure) = (judged.iter().find(|v| v.name == measure), measure.measure());
        Field {
            measure: Some(measure.key()),
            limit: limit.map(|verdict| verdict.limit),
            ..Field::new(key, name, measure.label(), measure.unit().shown, ends)
        }
    }

    /// With another label; it is then no value of the measure itself.
    pub fn with_label(self, label: String) -> Self {
        Field { label, measure: None, ..self }
    }

    /// With values in cells.
    pub fn on_cells(self) -> Self {
        Field { on: "cell", ..self }
    }

    /// With equal ratios equally far apart; both ends are positive.
    pub fn in_orders(self) -> Self {
        Field { scale: "orders", ..self }
    }
}

/// Lowest and highest of some numbers; zeros of none.
pub(super) fn ends(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let low = values.clone().fold(f64::INFINITY, f64::min);
    if low.is_finite() { [low, values.fold(low, f64::max)] } else { [0.0; 2] }
}
