//! Whether the limits of a result that was read are those of its scene, and hold by their values: the words `ok` and `accepted` prove
//! nothing.

use super::ResultFile;
use plydrape::layup::Layup;
use plydrape::measure::{Name, Scope, Verdict};
use plydrape::motion::Motion;

/// Limits that are formed twice differ by less, as a share.
const ROUNDING: f64 = 1e-9;

/// What is impossible in the verdicts of the model that decides.
pub(super) fn fault(result: &ResultFile) -> Option<String> {
    let limits = &result.summary.limits;
    let exceeded = |v: &&Verdict| v.ok && !v.name.measure().sense().keeps(v.value, v.limit);
    if let Some(Verdict { name, value, limit, .. }) = limits.iter().find(exceeded) {
        let label = name.measure().label();
        return Some(format!("it says that {label} is kept, which is {value} against {limit}"));
    }
    // limits apply to a layup and need no motion
    let motion = Motion { times: Vec::new(), positions: Vec::new() };
    let layup = Layup { motion, ..result.layup() };
    Name::ALL.iter().find_map(|name| {
        let limit = name.limit(&layup, &result.scene.limits)?;
        limit_fault(
            result,
            *name,
            if *name == Name::Sensitivity { sensitivity(result, limit) } else { limit },
        )
    })
}

/// The limit of the sensitivity, at least `least`: what the verdict says, as far as the height leaves that.
fn sensitivity(result: &ResultFile, least: f64) -> f64 {
    let verdict_of = |name: Name| result.summary.limits.iter().find(|verdict| verdict.name == name);
    let left = verdict_of(Name::Height).map_or(0.0, |height| height.limit - height.value);
    let factor = Name::Sensitivity.measure().unit().factor;
    let said = verdict_of(Name::Sensitivity).map_or(least, |verdict| verdict.limit / factor);
    said.clamp(least, least.max(left / factor))
}

/// What is impossible in the verdict on a measure with a limit of its scene (in the measure's own unit).
fn limit_fault(result: &ResultFile, name: Name, limit: f64) -> Option<String> {
    let measure = name.measure();
    let label = measure.label();
    let values = || result.steps.iter().filter_map(|step| step.measures.value(name));
    let judged = match measure.scope() {
        Scope::EveryStep => values().find(|value| !measure.sense().keeps(*value, limit)),
        Scope::End => values().next_back().filter(|value| !measure.sense().keeps(*value, limit)),
        Scope::Time | Scope::Motion | Scope::Whole => None,
    };
    let in_steps =
        matches!(measure.scope(), Scope::EveryStep | Scope::End) && values().next().is_some();
    let factor = measure.unit().factor;
    match result.summary.limits.iter().find(|verdict| verdict.name == name) {
        None if in_steps => Some(format!("its {label} is not judged, and its scene limits it")),
        None => None,
        Some(v) if (v.limit - limit * factor).abs() > ROUNDING * v.limit.abs() => {
            let of_scene = limit * factor;
            Some(format!("its limit of {label} is {}, and that of its scene {of_scene}", v.limit))
        }
        Some(v) if v.ok => judged.map(|value| {
            let value = value * factor;
            format!("it says that {label} is kept, which a step has at {value} against {}", v.limit)
        }),
        Some(_) => None,
    }
}
