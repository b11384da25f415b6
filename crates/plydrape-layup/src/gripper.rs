//! The name of a gripper: `g2_0` is that of the third along u in the first row along v.
//!
//! It is one word of letters, digits and `_` that begins with a letter, so that it can be written as it is in a table, as a joint
//! of ROS 2, as a set of a deck and as a variable of a robot program. Earlier versions wrote it in other ways, which are
//! still read.

/// A gripper by its grid indices `[i, j]`, from `[0, 0]`: i along u, j along v.
pub type GripperId = [usize; 2];

/// The name of a gripper, `g2_0`.
#[must_use]
pub fn gripper_name([i, j]: GripperId) -> String {
    format!("g{i}_{j}")
}

/// The gripper of a name: `g2_0`, or as earlier versions wrote it, `2-0`, `gripper_2_0`, `[2, 0]` or `gripper [2, 0]`.
/// Small and capital letters are alike, because programs for decks change them.
#[must_use]
pub fn read_gripper_name(text: &str) -> Option<GripperId> {
    let text = text.trim().to_ascii_lowercase();
    let bare = text.strip_prefix("gripper").or_else(|| text.strip_prefix('g'));
    let rest = bare.unwrap_or(&text).trim_start();
    let pair = |text: &str, separator: char| {
        let (i, j) = text.split_once(separator)?;
        Some([whole(i.trim())?, whole(j.trim())?])
    };
    match (rest.strip_prefix('['), bare) {
        (Some(list), _) => pair(list.strip_suffix(']')?, ','),
        (None, Some(_)) => pair(rest.strip_prefix('_').unwrap_or(rest), '_'),
        (None, None) => pair(rest, '-'),
    }
}

/// A whole number of digits alone.
fn whole(text: &str) -> Option<usize> {
    text.bytes().all(|digit| digit.is_ascii_digit()).then(|| text.parse().ok())?
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is written is read, and so is every form that an earlier version wrote.
    #[test]
    fn a_name_is_read_in_every_form_in_which_it_was_written() {
        for id in [[0, 0], [2, 0], [12, 345]] {
            assert_eq!(read_gripper_name(&gripper_name(id)), Some(id));
        }
        let forms = ["g2_10", "2-10", " 2 - 10", "gripper_2_10", "GRIPPER_2_10", "G2_10"];
        for form in forms.into_iter().chain(["[2, 10]", "[2,10]", "gripper [2, 10]"]) {
            assert_eq!(read_gripper_name(form), Some([2, 10]), "{form}");
        }
    }

    /// No name is guessed from what is nearly one.
    #[test]
    fn other_texts_are_no_names() {
        let none = ["", "g", "2", "g2", "g2-0", "2_0", "g2_0_x", "-2-0", "[2 0]", "[2,0", "g+2_0"];
        for text in none.into_iter().chain(["cell [2,0", "g_", "2-", "g2_99999999999999999999"]) {
            assert_eq!(read_gripper_name(text), None, "{text}");
        }
    }
}
