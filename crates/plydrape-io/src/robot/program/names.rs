//! Names of programs, and of what they declare, made from the title of a scene.
//!
//! `ply_front_fen_3k2p` is the scene "Front fender left", and `p02_patch_fro_7a1c` the second ply, "patch", of the plybook with this
//! title. A prefix that no word of a language has comes first; a few letters of the title say to people what it is; four signs of
//! a check sum of the whole title keep apart what begins alike, or is written in letters that controllers do not know. The plies
//! of a book differ by their numbers.
//!
//! What a program declares for itself is named after it, with another beginning (`tool_ply_front_fen_3k2p`), so that programs of two
//! plies can be loaded beside one another.

use super::context::ascii;
use plydrape::scene::BookPly;

/// Longest name: KRL has 24 letters, of which a beginning such as `mold_`, or the number of a part behind, takes 5 (KUKA System
/// Software 8.x, Operating and Programming Instructions for System Integrators); RAPID has 32.
const LONGEST: usize = 19;
/// Signs of the check sum.
const SIGNS: usize = 4;

/// The name of a program, in letters, digits and `_` that every controller takes.
pub(super) fn name(title: &str, book_ply: Option<&BookPly>) -> String {
    let signs = signs(title);
    let (prefix, title) = match book_ply {
        Some(ply) => (format!("p{:02}", ply.number), format!("{} {title}", ply.name)),
        None => ("ply".to_owned(), title.to_owned()),
    };
    let mut name = format!("{prefix}_{}", plain(&title));
    name.truncate(LONGEST - 1 - SIGNS);
    format!("{}_{signs}", name.trim_end_matches('_'))
}

/// A text in small letters and digits, with one `_` for whatever is between them.
fn plain(text: &str) -> String {
    let mut name = String::new();
    for letter in ascii(text).to_ascii_lowercase().chars() {
        match letter {
            'a'..='z' | '0'..='9' => name.push(letter),
            _ if name.ends_with('_') || name.is_empty() => {}
            _ => name.push('_'),
        }
    }
    name
}

/// Four signs of the check sum (CRC-32) of a text, of which the first is a digit.
fn signs(text: &str) -> String {
    let mut sum = crc32fast::hash(text.as_bytes());
    let mut sign = |count: u32| {
        let digit = char::from_digit(sum % count, count).unwrap_or('0');
        sum /= count;
        digit
    };
    let first = sign(10);
    std::iter::once(first).chain((1..SIGNS).map(|_| sign(36))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Words of RAPID, KRL and URScript, and names of data and instructions that a title may well be.
    const WORDS: &str = "alias and backward case connect const default div do else elseif endfor endfunc endif endmodule endproc \
        endrecord endtest endtrap endwhile error exit false for from func goto if inout local mod module nostepin not noview or pers \
        proc raise readonly record retry return step sysmodule test then to trap true trynext undo var viewonly while with xor \
        anin anout channel confirm continue decl def defdat deffct deftab ext enum exor global halt interrupt is lin lin_rel loop \
        maximum minimum next ptp ptp_rel resume repeat signal spline spl sptp struc switch until wait when break elif end in \
        thread run join kill movej movel movec servoj speedj stopj stopl sync sleep tool stop go at floor mold base world frame \
        ply part point n dt steps array_start array_ready tool0 wobj0 main user start init";

    fn named(title: &str) -> String {
        name(title, None)
    }

    fn in_book(number: usize, ply: &str, title: &str) -> String {
        name(&format!("{title}: {ply}"), Some(&BookPly { number, name: ply.into() }))
    }

    fn is_valid(name: &str) -> bool {
        name.len() <= LONGEST
            && name.starts_with('p')
            && name.chars().all(|letter| matches!(letter, 'a'..='z' | '0'..='9' | '_'))
            && WORDS.split_whitespace().all(|word| word != name)
    }

    #[test]
    fn a_name_says_whose_it_is_in_its_first_letters() {
        assert!(named("Flat mold, sheared target").starts_with("ply_flat_mold_"));
        assert!(in_book(2, "patch", "Front fender left").starts_with("p02_patch_"));
        assert!(named("Über-Form").starts_with("ply_uber_form_"));
    }

    /// Titles that are words of a language, too long, of letters that no controller knows, or of none at all.
    #[test]
    fn every_title_becomes_a_name_of_its_own() {
        // words of the languages of robots, in small and capital letters
        let mut titles: Vec<String> = WORDS.split_whitespace().map(str::to_owned).collect();
        let capital: Vec<String> = titles.iter().map(|word| word.to_uppercase()).collect();
        titles.extend(capital);

        // titles that differ only in what a name cannot have, or behind its longest length
        let long = "x".repeat(200);
        for title in [
            "",
            " ",
            "_",
            "a",
            "A",
            "3rd ply",
            "3",
            "左前翼子板",
            "右前翼子板",
            "Ä",
            "ä",
            "Ü",
            "😀",
            "?",
            "??",
            "a-b",
            "a b",
            "a_b",
            "a  b",
            "Front fender left",
            "Front fender left: base",
            "Front fender left: patch",
            "ply",
            "ply_ply",
            "p01_a",
            "\"; END",
            "! x",
            "{{ x }}",
            "=1+1",
        ] {
            titles.push(title.into());
        }
        titles.extend([
            long.clone(),
            format!("{long}y"),
            format!("{long} left"),
            format!("{long} right"),
        ]);

        // as many names as titles, each of them valid
        let names: BTreeSet<String> = titles.iter().map(|title| named(title)).collect();
        let distinct: BTreeSet<&String> = titles.iter().collect();
        assert_eq!(names.len(), distinct.len());
        assert!(names.iter().all(|name| is_valid(name)), "{names:?}");
    }

    /// However alike their names are, the plies of a book differ by their numbers; and so do those of two books by their titles.
    #[test]
    fn the_plies_of_a_book_have_names_of_their_own() {
        let long = "Front fender left, inner side, second revision".repeat(4);
        let mut names = BTreeSet::new();
        for title in ["Front fender left", "Front fender right", &long] {
            for number in 1..=120 {
                let name = in_book(
                    number,
                    if number % 2 == 0 { "基" } else { "base, the same for all" },
                    title,
                );
                assert!(is_valid(&name), "{name}");
                assert!(names.insert(name));
            }
        }
    }
}
