//! What published data say of the strength that fiber angles cost, in words: information beside what was measured.

use plydrape::measure::{Loss, Name, Plane, Published};
use plydrape::outcome::Summary;
use serde::Serialize;

/// What one source says beside the angles that were found.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Note {
    /// The angles that were found, as in `fiber angle 2.1°`.
    pub angles: String,
    /// What the source says, and of what it holds.
    pub text: String,
    /// The source.
    pub source: String,
}

/// What stands below all notes.
pub const INFORMATION: &str = "This is information, and no prediction for your laminate.";

/// What published data say of the angles at the end of a drape, by the model that decides.
#[must_use]
pub fn notes(summary: &Summary) -> Vec<Note> {
    let of = |(published, angles): (&Published, Vec<(Name, f64)>)| {
        (!angles.is_empty()).then(|| note(published, &angles))
    };
    let angles = |plane: Plane| -> Vec<(Name, f64)> {
        let own = |(name, _): &(Name, f64)| Plane::of(*name) == Some(plane);
        found(summary).into_iter().filter(own).collect()
    };
    Published::ALL
        .iter()
        .map(|published| (published, angles(published.plane)))
        .filter_map(of)
        .collect()
}

/// The angles at the end (°), as far as the model that decides knows them.
fn found(summary: &Summary) -> Vec<(Name, f64)> {
    let names = [Name::OutOfPlane, Name::SlackAngle, Name::WrinkleAngle, Name::FibreAngle];
    names.into_iter().filter_map(|name| Some((name, summary.last.value(name)?))).collect()
}

fn note(published: &Published, angles: &[(Name, f64)]) -> Note {
    let label =
        |(name, angle): &(Name, f64)| format!("{} {}", name.measure().label(), degrees(*angle));
    let places = angles.iter().filter_map(|(_, angle)| place(published, *angle));
    let mut text = format!("{} ({}).", capital(published.says), published.range);
    let mut before = String::new();
    for place in places {
        // two angles that stand at the same place
        if place != before {
            text += &format!(" {place}");
        }
        before = place;
    }
    Note {
        angles: angles.iter().map(label).collect::<Vec<_>>().join(", "),
        text,
        source: published.source.into(),
    }
}

/// Where an angle (°) stands in what a source says, as a sentence.
fn place(published: &Published, angle: f64) -> Option<String> {
    let shown = degrees(angle);
    Some(match published.loss(angle.to_radians())? {
        Loss::Between([low, high]) if low == high => {
            format!("For {shown} that is {}.", percent(low))
        }
        Loss::Between([low, high]) => {
            format!("{shown} is between these angles: {} to {}.", percent(low), percent(high))
        }
        Loss::Below(least, _) => format!(
            "{shown} is below {}, the smallest angle that it gives, so it says nothing about it.",
            degrees(least.to_degrees())
        ),
        Loss::Beyond(most, _) => format!(
            "{shown} is beyond {}, the largest angle that it gives, so it says nothing about it.",
            degrees(most.to_degrees())
        ),
        Loss::NoAngle(_) => {
            "What was read of it gives no angle, so that the angles here have no place in it."
                .into()
        }
    })
}

/// What is carried of published data, for a list: what each says, of what, and its source.
#[must_use]
pub fn published() -> Vec<Note> {
    let of = |published: &Published| Note {
        angles: match published.plane {
            Plane::InPlane => "in the plane of the ply".into(),
            Plane::OutOfPlane => "out of the plane of the ply".into(),
        },
        text: format!("{} ({}).", capital(published.says), published.range),
        source: published.source.into(),
    };
    Published::ALL.iter().map(of).collect()
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or(String::new(), |first| first.to_uppercase().chain(chars).collect())
}

/// Three digits at most.
fn degrees(angle: f64) -> String {
    let rounded: f64 = format!("{angle:.2e}").parse().unwrap_or(angle);
    format!("{rounded}°")
}

fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    fn drape(angles: &[(Name, f64)]) -> Summary {
        let mut summary = sample::draped(4, 2, 3).summary;
        summary.last = angles.iter().map(|(name, angle)| (*name, Some(*angle))).collect();
        summary
    }

    /// Every note has a source; an angle outside what is published is said to be so.
    #[test]
    fn an_angle_that_nothing_is_published_of_is_said_to_be_outside() {
        let text = |angle: f64| {
            let [note] = &notes(&drape(&[(Name::FibreAngle, angle)]))[..] else { panic!("one") };
            assert!(note.source.contains("TM 1-1500-204-23-11"), "{}", note.source);
            note.text.clone()
        };
        assert!(text(2.1).ends_with(
            "2.1° is below 5°, the smallest angle that it gives, so it says nothing about it."
        ));
        assert!(text(7.0).ends_with("7° is between these angles: 20 % to 50 %."), "{}", text(7.0));
        assert!(text(12.0).contains("12° is beyond 10°"));
        assert!(text(5.0).ends_with("For 5° that is 20 %."));
        let waves = &notes(&drape(&[(Name::SlackAngle, 2.6), (Name::WrinkleAngle, 9.0)]))[0];
        assert_eq!(waves.angles, "slack as fiber angle 2.6°, wrinkle angle 9°");
        assert_eq!(waves.text.matches("no angle").count(), 1);
        assert!(waves.text.starts_with("Published tests found up to 36 %"), "{}", waves.text);
        assert_eq!(notes(&drape(&[])), []);
    }

    /// Nobody reads a promise out of it: it names no standard as kept.
    #[test]
    fn no_note_and_no_preset_claims_conformity() {
        let notes = published().into_iter().flat_map(|note| [note.angles, note.text, note.source]);
        let presets = plydrape::measure::Preset::ALL.iter().flat_map(|preset| {
            let sources = preset.figures().iter().map(|figure| figure.source.to_string());
            sources.chain([preset.about().to_string()]).collect::<Vec<_>>()
        });
        for text in notes.chain(presets) {
            for word in ["conform", "complies", "compliant", "certif", "in accordance"] {
                assert!(!text.to_lowercase().contains(word), "{text}");
            }
        }
    }

    /// The angles of a sheet, each beside its own plane.
    #[test]
    fn each_angle_stands_beside_what_is_published_of_its_plane() {
        let summary = drape(&[(Name::OutOfPlane, 4.0), (Name::FibreAngle, 6.0)]);
        let angles: Vec<String> = notes(&summary).into_iter().map(|note| note.angles).collect();
        assert_eq!(angles, ["fiber angle 6°", "fiber angle out of plane 4°"]);
    }
}
