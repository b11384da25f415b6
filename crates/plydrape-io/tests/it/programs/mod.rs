//! Programs for controllers, read back by readers that know the languages and not the templates.
//!
//! Each reader refuses whatever it does not know, and plays what it has read: where the center of the tool, the external
//! axes and the vacuum are at which time. What is played is compared with the program at every sample.

mod cell;
mod declared;
mod emulated;
mod krl;
mod rapid;
mod ros2;
mod script;
mod tokens;
mod urscript;

use cell::{Played, cell, rejected, text};
use plydrape::mold::Pose;
use plydrape::scene::BookPly;
use plydrape_io::robot::program::{Pad, Program, Robot, Template, Tolerance, template, wide};
use plydrape_io::{Error, Files};
use std::collections::BTreeSet;

fn files(program: &Program, robot: Robot, position: f64) -> Files {
    template::files(program, robot, &[], &dense(position)).unwrap()
}

/// As many points as an error needs, however near to each other.
fn dense(position: f64) -> Tolerance {
    Tolerance { position, least_way: 0.0, least_time: 0.0, ..Tolerance::default() }
}

fn names(files: &Files) -> Vec<&str> {
    files.iter().map(|(name, _)| name.as_str()).collect()
}

fn played(robot: Robot, files: &Files) -> Played {
    match robot {
        Robot::Rapid => rapid::play(files),
        Robot::Krl => krl::play(files),
        Robot::Urscript => urscript::play(files),
    }
}

/// Each controller's file, played, is where the program is, to within the error that its head states; frames, vacuum and
/// the six external axes are those of the program.
#[test]
fn what_a_controller_reads_is_the_program_within_the_stated_error() {
    for (robot, axes) in
        [(Robot::Rapid, 6), (Robot::Krl, 6), (Robot::Urscript, 0), (Robot::Rapid, 0)]
    {
        let program = cell(axes, 1001);
        for position in [1e-3, 1e-4, 1e-5] {
            let files = files(&program, robot, position);
            let played = played(robot, &files);
            let stated = cell::stated(&files);
            assert!(stated.position <= position, "{robot:?} {stated:?}");
            played.compare(&program, stated);
            let count = played.points.len();
            assert!((10..1010).contains(&count), "{robot:?} {position} {count}");
        }
    }
}

/// A controller that moves fewer axes than the array has gets the progress of the motion instead; the axes are in tables beside it, of which
/// one holds every number of the program to the last bit.
#[test]
fn axes_beyond_a_controllers_own_go_to_a_table_beside_it() {
    for (robot, axes) in [(Robot::Rapid, 7), (Robot::Krl, 12), (Robot::Urscript, 4)] {
        let program = cell::still(cell(axes, 1001));
        let files = files(&program, robot, 1e-4);
        let program_file = names(&files)[0].split('.').next().unwrap();
        let tables = ["wide", "cam"].map(|kind| format!("{program_file}_{kind}.csv"));
        assert_eq!(names(&files)[names(&files).len() - 2..], tables);
        let head = text(&files, 0).replace(['!', ';', '#'], "");
        let head = head.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(head.contains("override, stop, resume and emergency stop hold both"), "{head}");
        assert!(head.contains("NEVER with a speed below 100 %"), "{head}");
        let played = played(robot, &files);
        assert!(played.starts_array);
        played.compare(&program, cell::stated(&files));
        cell::compare_wide(&text(&files, files.len() - 2), &program);
    }
}

/// The head states the shortest time between two points, which a controller must keep up with.
#[test]
fn a_head_says_how_close_its_points_are_in_time() {
    for position in [1e-3, 1e-5] {
        let files = files(&cell(6, 1001), Robot::Rapid, position);
        let head = text(&files, 0);
        let line = head.lines().find(|line| line.contains("apart or more")).unwrap();
        let stated: f64 = line.split_whitespace().nth(3).unwrap().parse().unwrap();
        let played = played(Robot::Rapid, &files);
        let gaps = played.points.windows(2).filter(|pair| !pair[1].pose.eq(&pair[0].pose));
        let least = gaps.map(|pair| pair[1].time - pair[0].time).fold(f64::INFINITY, f64::min);
        assert!((stated - least).abs() < 1e-4, "{stated} {least}");
    }
}

/// 18 grippers of a UR use its eight standard, eight configurable and two outputs at the tool, each by its own function: the
/// old `set_digital_out` switches the tool's at 8 and 9.
#[test]
fn a_ur_switches_each_output_by_the_function_of_its_kind() {
    let mut program = cell(0, 101);
    let pad = program.pads[0].clone();
    for n in program.pads.len()..18 {
        program.pads.push(Pad { name: format!("g{n}_5"), ..pad.clone() });
    }
    let all = (0..18).map(|n| if n < 4 { cell::IDS[n] } else { [n, 5] }).collect();
    program.events.truncate(1);
    program.events[0].grippers = all;
    let text = text(&files(&program, Robot::Urscript, 1e-3), 1);
    for line in [
        "set_standard_digital_out(7, on)",
        "set_configurable_digital_out(0, on)",
        "set_configurable_digital_out(7, on)",
        "set_tool_digital_out(0, on)",
        "set_tool_digital_out(1, on)",
        "def vac_g9_5_ply_cell_of_th_",
    ] {
        assert!(text.contains(line), "{line}");
    }
}

/// Who interpolates the four numbers of a row gets no jump where the flange turns through half a turn.
#[test]
fn quaternions_of_a_table_keep_their_sign() {
    let mut program = cell(0, 1001);
    // about half a turn about x, as a flange that looks down, a little to this side and that
    let flange = program.times.iter().map(|t| {
        Pose::new([0.0; 3], [std::f64::consts::PI + 0.01 * (9.0 * t).sin(), 0.0, 0.1 * t])
    });
    program.flange = Some(flange.collect());
    let table = wide::text(&program).unwrap();
    let rows: Vec<[f64; 4]> = table
        .lines()
        .skip(1)
        .map(|row| {
            let row: Vec<f64> = row.split(',').map(|cell| cell.parse().unwrap()).collect();
            [row[4], row[5], row[6], row[7]]
        })
        .collect();
    for pair in rows.windows(2) {
        let cosine: f64 = pair[0].iter().zip(pair[1]).map(|(a, b)| a * b).sum();
        assert!(cosine > 0.99, "{pair:?}");
    }
}

/// 5000 points are the most of a file: what needs more is in parts, which play as one motion.
#[test]
fn a_program_of_too_many_points_is_split() {
    let program = cell(6, 20_001);
    for robot in Robot::ALL {
        let program = if robot == Robot::Urscript { cell(0, 20_001) } else { program.clone() };
        let files = files(&program, robot, 1e-8);
        let parts = names(&files).iter().filter(|name| !name.contains("_cell.")).count();
        assert!(parts >= 2, "{:?}", names(&files));
        assert!(text(&files, 0).contains("part 1 of"));
        let played = played(robot, &files);
        assert!(played.points.len() > 5000);
        played.compare(&program, cell::stated(&files));
    }
}

/// Titles that are words of a language or names of what a program declares, that are long, or that have no letter of ASCII; the
/// plies of two books; verdicts that quote any name. Every program is read back and plays its motion, all of them can be loaded
/// beside one another, and each fits its controller.
#[test]
fn programs_of_all_titles_can_be_loaded_beside_one_another() {
    let long = "Verkleidung".repeat(40);
    let quotes = "\"; END ! } # { ; MODULE x";
    let mut titles: Vec<(String, Option<BookPly>)> = [
        "Tool",
        "Stop",
        "Go",
        "At",
        "Mold",
        "Floor",
        "Servoj",
        "Error",
        "While",
        "Halt",
        "Module",
        "Main",
        "VAC_G0_0",
        "array_start",
        "XP1",
        "I",
        "BAS",
        "run",
        "",
        " ",
        "3rd",
        "007",
        "Größe",
        "Grösse",
        "左前",
        "右前",
        "=1+1",
        "ply",
        "ply tool",
        "tool",
        "front fender left: a",
        "front fender left: b",
        quotes,
        &long,
        &format!("{long} 2"),
    ]
    .map(|title| (title.to_owned(), None))
    .into();
    for book in ["Front fender left", "Front fender right", &long] {
        for (n, ply) in ["base", "patch", "Base!", "基"].into_iter().enumerate() {
            let of_book = BookPly { number: n + 1, name: ply.into() };
            titles.push((format!("{book}: {ply}"), Some(of_book)));
        }
    }
    for robot in Robot::ALL {
        let mut found: BTreeSet<String> = BTreeSet::new();
        let mut names_of_files: BTreeSet<String> = BTreeSet::new();
        for (title, book_ply) in &titles {
            let plain = cell::still(cell(7, 201));
            let verdict = format!(
                "not accepted: clearance of \"{quotes}\" and {long},=1+1,@x,-y,+HYPERLINK(1)"
            );
            let (name, book_ply) = (title.clone(), book_ply.clone());
            let program = Program { name, book_ply, verdict, accepted: false, ..plain };
            let files = files(&program, robot, 1e-3);
            let played = played(robot, &files);
            assert!(played.starts_array);
            played.compare(&program, cell::stated(&files));
            for (file, bytes) in &files {
                assert!(names_of_files.insert(file.to_lowercase()), "{file} of {title}");
                let stem = file.split('.').next().unwrap();
                assert!(
                    stem.trim_end_matches("_wide").trim_end_matches("_cam").len() <= 24
                        && stem.starts_with('p')
                        && stem.contains('_'),
                    "{file}"
                );
                let text = std::str::from_utf8(bytes).unwrap();
                // KRL takes 471 letters, and RAPID 255 of a line in its editor
                let is_short = |line: &str| line.is_ascii() && line.len() <= 255;
                assert!(file.ends_with(".csv") || text.lines().all(is_short), "{title}");
                if file.ends_with(".csv") {
                    assert_no_formula(text);
                }
            }
            let declared = declared::declared(robot, &files);
            declared::assert_sound(robot, &declared);
            let global = declared.global;
            assert!(!global.is_empty());
            for name in global {
                assert!(name.len() <= 32 && found.insert(name.to_lowercase()), "{name} of {title}");
            }
        }
    }
}

/// What was written once, the title as the name of everything, and words of the languages, is found: a name that is declared twice, in
/// other letters too, and one that is reserved.
#[test]
fn a_name_that_is_declared_twice_or_reserved_is_found() {
    for (robot, file, text) in [
        (Robot::Rapid, "a.mod", "MODULE ply_tool\n  PERS tooldata PLY_TOOL := [];\nENDMODULE\n"),
        (Robot::Rapid, "a.mod", "MODULE While\nENDMODULE\n"),
        (
            Robot::Krl,
            "a.dat",
            "DEFDAT a PUBLIC\nDECL FRAME XP1={X 0}\nDECL E6POS xp1={X 0}\nENDDAT\n",
        ),
        (Robot::Krl, "halt.src", "DEF halt ( )\nEND\n"),
        (Robot::Urscript, "a.script", "def stop():\n  def stop():\n  end\nend\n"),
        (Robot::Urscript, "a.script", "def servoj():\nend\n"),
    ] {
        let files: Files = vec![(file.into(), text.into())];
        let judged = || declared::assert_sound(robot, &declared::declared(robot, &files));
        assert!(std::panic::catch_unwind(judged).is_err(), "{text}");
    }
}

/// Columns of a table have names of their own, and no cell but a number begins as a formula of a spreadsheet does.
fn assert_no_formula(table: &str) {
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let header = table.lines().find(|line| !line.starts_with('#')).unwrap();
    let names: BTreeSet<String> = cells(header).into_iter().collect();
    assert_eq!(names.len(), cells(header).len(), "{header}");
    for cell in table.lines().flat_map(cells) {
        let is_formula = cell.starts_with(['=', '+', '-', '@', '\t']);
        assert!(!is_formula || cell.parse::<f64>().is_ok(), "{cell}");
    }
}

/// The head of a motion that is not accepted says so first.
#[test]
fn a_rejected_motion_says_so_in_its_head() {
    let program = rejected(cell(0, 1001));
    for robot in Robot::ALL {
        let files = files(&program, robot, 1e-4);
        // what is measured in a cell moves nothing
        let of_cell = |name: &str| robot.is_of_cell(name, &[]);
        for n in (0..files.len()).filter(|n| !of_cell(&files[*n].0)) {
            let text = text(&files, n);
            let head: Vec<&str> = text.lines().take(6).collect();
            assert!(
                head.iter().any(|line| line.contains("NOT ACCEPTED: tilt 57.1 deg")),
                "{head:?}"
            );
        }
        played(robot, &files).compare(&program, cell::stated(&files));
    }
    let table = wide::text(&program).unwrap();
    assert!(table.starts_with("# NOT ACCEPTED: tilt 57.1°"), "{table}");
}

/// Same program, same bytes.
#[test]
fn a_program_is_written_alike_every_time() {
    let program = cell::still(cell(6, 1001));
    for robot in Robot::ALL {
        assert!(files(&program, robot, 1e-4) == files(&program, robot, 1e-4));
    }
}

fn refused(program: &Program, robot: Robot, templates: &[Template]) -> String {
    told(&template::files(program, robot, templates, &Tolerance::default()).unwrap_err())
}

/// What is wrong, and what would help.
fn told(error: &Error) -> String {
    assert!(!error.help().is_empty(), "{error}");
    format!("{error}; {}", error.help())
}

/// Free grippers have no arm; a motion needs a time 0; a tolerance is above 0; an array needs as many outputs as it has
/// grippers. Each refusal says what to do.
#[test]
fn what_cannot_be_a_program_is_refused_with_a_remedy() {
    let program = cell(2, 101);
    let free = Program { flange: None, ..program.clone() };
    assert!(refused(&free, Robot::Rapid, &[]).contains("say in [tool] how the array is carried"));

    let late =
        Program { times: program.times.iter().map(|t| t + 1.0).collect(), ..program.clone() };
    assert!(refused(&late, Robot::Krl, &[]).contains("no point at 0 s"));
    let mut short = program.clone();
    short.axes[0].values.pop();
    assert!(refused(&short, Robot::Krl, &[]).contains("g0_0_z has not one finite value"));

    let usual = Tolerance::default();
    for (none, what) in [
        (Tolerance { position: 0.0, ..usual }, "position error of 0"),
        (Tolerance { least_way: -1.0, ..usual }, "the least way between points cannot be -1"),
        (
            Tolerance { least_time: f64::NAN, ..usual },
            "the least time between points cannot be NaN",
        ),
    ] {
        let fault = told(&template::files(&program, Robot::Rapid, &[], &none).unwrap_err());
        assert!(fault.contains(what), "{fault}");
    }

    let mut many = program.clone();
    let pad = many.pads[0].clone();
    many.pads.resize(18, pad);
    let fault = refused(&many, Robot::Urscript, &[]);
    assert!(fault.contains("18 digital outputs") && fault.contains("19 are needed"), "{fault}");
}

/// A copy that is changed takes the place of the shipped one; one with another ending is used alone.
#[test]
fn templates_of_the_user_are_used() {
    let program = cell(2, 101);
    let made = |robot, name: &str, text: &str| {
        let own = Template { name: name.into(), text: text.into() };
        template::files(&program, robot, &[own], &dense(1e-4))
    };
    let (_, shipped) = Robot::Rapid.shipped()[0];
    let changed = shipped.replace("v50", "v20");
    let copy = made(Robot::Rapid, "cell.mod.j2", &changed).unwrap();
    assert_eq!(text(&copy, 0), text(&files(&program, Robot::Rapid, 1e-4), 0).replace("v50", "v20"));

    let both = made(Robot::Krl, "my.dat.j2", "{{ part }}\n").unwrap();
    let name = names(&both)[0].strip_suffix(".src").unwrap();
    assert!(name.starts_with("ply_cell_of_th"), "{name}");
    assert_eq!(names(&both)[1], format!("{name}.dat"));
    assert_eq!(text(&both, 1), format!("{name}\n"));

    let other = "{% for block in blocks %}{% for p in block.points %}{{ p.position|mm(1)|join(' ') }}\n{% endfor %}{% endfor %}";
    let other = made(Robot::Krl, "cell.ls.j2", other).unwrap();
    assert_eq!(names(&other), [format!("{name}.ls")]);
    assert!(text(&other, 0).lines().all(|line| line.split(' ').count() == 3));
}

/// A template is a program of its user's: what does not end, makes more than fits, nests without end or prints everything is refused
/// with its line and the bound, and a number of digits that no double has is none.
#[test]
fn the_work_of_a_template_is_bounded() {
    let program = cell(0, 101);
    let loops = "{% for i in range(100000) %}{% for j in range(100000) %}{% endfor %}{% endfor %}";
    let doubled = "{% set x = 'x' %}".to_owned() + &"{% set x = x ~ x %}".repeat(60);
    for (text, what) in [
        (loops.to_owned(), "10 million steps"),
        (doubled, "10 million steps"),
        ("{{ 'x' * 10000000000 }}".into(), "10 million steps"),
        ("{% for x in [1] recursive %}{{ loop([x]) }}{% endfor %}".into(), "deeper than 100"),
        ("{{ [[1.5]]|mm }}".into(), "is no number"),
        ("{{ [[1.5]]|comment('!') }}".into(), "is no text"),
        ("{{ 1.5|fixed(70000) }}".into(), "fixed(70000) asks for more than 17 digits"),
        ("{{ 1.5|mm(18) }}".into(), "mm(18) asks for more than 17"),
        ("\n{{ debug() }}".into(), "line 2: `debug` is not there"),
        ("{% set a = namespace(x=1) %}".into(), "`namespace` is not there"),
        (" ".repeat(70_000), "65536 are the most"),
    ] {
        let own = Template { name: "cell.mod.j2".into(), text: text.clone() };
        let made = template::files(&program, Robot::Rapid, &[own], &Tolerance::default());
        let error = made.unwrap_err();
        let fault = error.to_string();
        assert!(fault.contains(what) && fault.len() < 300, "{fault}");
        assert!(fault.contains("line ") || text.starts_with(' '), "{fault}");
        assert!(!error.help().is_empty(), "{fault}");
    }
    let own = Template { name: "cell.mod.j2".into(), text: "{{ 0.1|fixed(17) }}".into() };
    let made = template::files(&program, Robot::Rapid, &[own], &Tolerance::default()).unwrap();
    assert_eq!(text(&made, 0), format!("{:.17}", 0.1));
}

/// A fault in a template is named with its line.
#[test]
fn a_template_with_a_fault_is_refused_with_its_line() {
    let program = cell(0, 101);
    for (text, what) in [
        ("\n{{ nothing }}\n", "line 2"),
        ("\n\n{% if %}\n", "line 3"),
        ("{{ head|mm }}", "is no number"),
        ("{{ title|unknown }}", "unknown"),
    ] {
        let own = Template { name: "cell.mod.j2".into(), text: text.into() };
        let fault = refused(&program, Robot::Rapid, &[own]);
        assert!(fault.contains("cell.mod.j2") && fault.contains(what), "{fault}");
    }
}
