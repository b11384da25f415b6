//! The names that programs declare, found by the words of the languages alone.

use plydrape_io::Files;
use plydrape_io::robot::program::Robot;

/// Reserved words of RAPID: ABB, Technical reference manual, RAPID kernel (3HAC050946), 2.2 Identifiers.
const RAPID: &str = "alias and backward case connect const default div do else elseif endfor endfunc endif endmodule endproc \
    endrecord endtest endtrap endwhile error exit false for from func goto if inout local mod module nostepin not noview or pers \
    proc raise readonly record retry return step sysmodule test then to trap true trynext undo var viewonly while with xor";

/// Keywords of KRL: KUKA System Software 8.3, Operating and Programming Instructions for System Integrators, 11.4 and 11.5.
const KRL: &str = "and anin anout b_and b_exor b_not b_or bool brake c_dis c_ori c_ptp c_vel case channel char circ circ_rel confirm \
    const continue decl def default defdat deffct delay do else end enddat endfct endfor endif endloop endspline endswitch \
    endwhile enum exit exor ext extfct extfctp extp false for frame global goto halt if import int interrupt inv_pos is lin \
    lin_rel loop maximum minimum not off on or pos e6pos e6axis axis prio private ptp ptp_rel ptp_spline public pulse real repeat resume return \
    scirc scirc_rel sec signal slin slin_rel spl spl_rel spline sptp sptp_rel step struc switch then time_block to trigger true \
    until wait when while with";

/// Keywords of URScript, and what a program calls: Universal Robots, The URScript Programming Language, SW 5.11, 1 and 2.
const URSCRIPT: &str = "and break continue def elif else end false global halt if in join kill local mod not or p return run sec \
    step thread true while xor floor get_inverse_kin get_standard_digital_in get_steptime interpolate_pose movec movej movel movep \
    pose_trans popup servoc servoj set_configurable_digital_out set_standard_digital_out set_tcp set_tool_digital_out sleep \
    speedj speedl stopj stopl sync textmsg";

/// What a program declares.
#[derive(Debug, Default)]
pub struct Declared {
    /// Names that a controller knows everywhere once all files are loaded.
    pub global: Vec<String>,
    /// Names of one file or function, with where that is.
    pub local: Vec<(String, String)>,
}

/// The words of a line of code, without texts and what is behind the mark of a comment.
fn words<'a>(line: &'a str, comment: &str) -> Vec<&'a str> {
    let code = line.split_once(comment).map_or(line, |(code, _)| code);
    let letters = |c: char| !(c.is_ascii_alphanumeric() || c == '_');
    code.split('"')
        .step_by(2)
        .flat_map(|part| part.split(letters))
        .filter(|w| !w.is_empty())
        .collect()
}

/// What the files of a program declare.
pub fn declared(robot: Robot, files: &Files) -> Declared {
    let mut found = Declared::default();
    let code = files.iter().filter(|(name, _)| !name.ends_with(".csv"));
    for (file, bytes) in code {
        let mut function = String::new();
        for line in std::str::from_utf8(bytes).unwrap().lines() {
            let Declared { global, local } = &mut found;
            let mut of_file = |place: &str, name: &str| local.push((place.into(), name.into()));
            match robot {
                Robot::Rapid => match words(line, "!")[..] {
                    ["MODULE" | "PROC", name, ..] | ["PERS" | "VAR" | "CONST", _, name, ..] => {
                        global.push(name.into());
                    }
                    ["SetDO" | "WaitDI", name, ..] => of_file("signals", name),
                    _ => {}
                },
                Robot::Krl => match words(line, ";")[..] {
                    // the data of a program has its name
                    ["DEF", name, ..] => global.push(name.into()),
                    ["DECL", _, name, ..] | ["SIGNAL" | "INT", name, ..] => {
                        of_file(file.trim_end_matches(".dat").trim_end_matches(".src"), name);
                    }
                    _ => {}
                },
                Robot::Urscript => match words(line, "#")[..] {
                    ["def", name, ref parameters @ ..] => {
                        global.push(name.into());
                        function = name.into();
                        parameters.iter().for_each(|name| of_file(&function, name));
                    }
                    ["global", name, ..] => global.push(name.into()),
                    ["local", name, ..] => of_file(&function, name),
                    _ => {}
                },
            }
        }
    }
    // a signal is used again and again
    found.local.sort();
    if robot == Robot::Rapid {
        found.local.dedup();
    }
    found
}

/// Asserts that every name is declared once where it is known, is no word of the language, and is short enough.
pub fn assert_sound(robot: Robot, declared: &Declared) {
    let (reserved, longest) = match robot {
        Robot::Rapid => (RAPID, 32),
        Robot::Krl => (KRL, 24),
        Robot::Urscript => (URSCRIPT, 32),
    };
    // RAPID and KRL take small and capital letters for the same
    let all = declared.global.iter().chain(declared.local.iter().map(|(_, name)| name));
    for name in all.clone() {
        let lower = name.to_lowercase();
        assert!(reserved.split_whitespace().all(|word| word != lower), "{name} is reserved");
        assert!(
            name.len() <= longest && name.starts_with(|c: char| c.is_ascii_alphabetic()),
            "{name}"
        );
    }
    for (n, name) in declared.global.iter().enumerate() {
        let twice = |other: &&String| other.eq_ignore_ascii_case(name);
        let count = all.clone().filter(twice).count();
        assert_eq!(count, 1, "{name}, number {n}, is declared {count} times");
    }
    let mut local: Vec<(String, String)> =
        declared.local.iter().map(|(place, name)| (place.clone(), name.to_lowercase())).collect();
    local.sort();
    for pair in local.windows(2) {
        assert_ne!(pair[0], pair[1]);
    }
}
