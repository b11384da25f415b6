use super::*;
use crate::Error;
use proptest::prelude::*;
use std::collections::BTreeMap;

/// Everything in a folder: name and content, `None` for a folder.
fn contents(dir: &Path) -> BTreeMap<String, Option<Vec<u8>>> {
    fs::read_dir(dir)
        .unwrap()
        .map(|entry| {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, fs::read(path).ok())
        })
        .collect()
}

fn names(dir: &Path) -> Vec<String> {
    contents(dir).into_keys().collect()
}

/// A rerun, longer or shorter, replaces what the run before wrote and leaves nothing else behind.
#[test]
fn a_rerun_replaces_its_own_files() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path().join("deep/out");
    write(&dir, "simulate", &[("result.json", b"one"), ("old.svg", b"stale")], &[]).unwrap();
    let paths =
        write(&dir, "simulate", &[("result.json", b"two"), ("steps.csv", b"s")], &[]).unwrap();
    assert_eq!(paths, [dir.join("result.json"), dir.join("steps.csv")]);
    assert_eq!(names(&dir), [".plydrape", "result.json", "steps.csv"]);
    assert_eq!(fs::read(dir.join("result.json")).unwrap(), b"two");
    write(&dir, "simulate", &[("result.json", b"two")], &[]).unwrap();
    assert_eq!(names(&dir), [".plydrape", "result.json"]);
}

/// The user's own `result.json` was there first.
#[test]
fn a_file_of_the_users_is_never_overwritten() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("result.json"), "mine").unwrap();
    let before = contents(dir.path());
    let fault = write(dir.path(), "simulate", &[("steps.csv", b"s"), ("result.json", b"r")], &[])
        .unwrap_err();
    assert!(matches!(&fault, Error::Foreign { path } if path.ends_with("result.json")));
    assert!(fault.to_string().contains("-o"), "{fault}");
    assert_eq!(contents(dir.path()), before);
}

/// A file that plydrape wrote and the user then edited is the user's; a stale one stays too.
#[test]
fn an_edited_file_is_the_users() {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "simulate", &[("a", b"1"), ("b", b"2")], &[]).unwrap();
    fs::write(dir.path().join("b"), "9").unwrap();
    let before = contents(dir.path());
    assert!(write(dir.path(), "simulate", &[("a", b"3"), ("b", b"4")], &[]).is_err());
    assert_eq!(contents(dir.path()), before);
    write(dir.path(), "simulate", &[("a", b"3")], &[]).unwrap();
    assert_eq!(fs::read(dir.path().join("b")).unwrap(), b"9");
}

/// A folder where a file should go stops the run before the first file.
#[test]
fn a_folder_in_the_way_leaves_everything_as_it_was() {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "simulate", &[("a", b"1")], &[]).unwrap();
    fs::create_dir(dir.path().join("c")).unwrap();
    let before = contents(dir.path());
    assert!(write(dir.path(), "simulate", &[("a", b"2"), ("b", b"2"), ("c", b"2")], &[]).is_err());
    assert_eq!(contents(dir.path()), before);
}

/// The disk refuses in the middle of the moves: the moves done so far are taken back.
#[test]
fn a_move_that_fails_in_the_middle_is_undone() {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "simulate", &[("a", b"1"), ("gone", b"1")], &[]).unwrap();
    let before = contents(dir.path());
    let stage = tempfile::Builder::new().prefix(".plydrape-").tempdir_in(dir.path()).unwrap();
    for name in ["a", "b"] {
        stage_file(stage.path(), dir.path(), name, &&b"2"[..]).unwrap();
    }
    let mut moves = Moves::new(dir.path(), Stage(stage));
    moves.put("a", "a").unwrap();
    moves.put("b", "b").unwrap();
    moves.take("gone").unwrap();
    // Never staged, so the rename fails as it would on a broken disk.
    let fault = moves.put("c", "c").unwrap_err();
    assert!(matches!(moves.undo(fault), Error::Io { .. }));
    assert_eq!(contents(dir.path()), before);
}

/// The disk refuses in the second of two folders that are written together: the first one is as it was too.
#[test]
fn a_move_that_fails_in_one_folder_is_undone_in_all() {
    let home = tempfile::tempdir().unwrap();
    let dirs = ["one", "two"].map(|name| home.path().join(name));
    for dir in &dirs {
        write(dir, "plan", &[("a", b"1"), ("gone", b"1")], &[]).unwrap();
    }
    let before = dirs.each_ref().map(|dir| contents(dir));
    let stage = |dir: &PathBuf| {
        let folder = Folder::claim(dir, "plan", &[]).unwrap();
        folder.stage_files(&[("a", &b"2"[..]), ("b", &b"2"[..])]).unwrap()
    };
    let staged: Vec<Staged> = dirs.iter().map(stage).collect();
    fs::remove_file(staged[1].folder.stage().join("new-b")).unwrap();
    assert!(matches!(write_together(staged), Err(Error::Io { .. })));
    assert_eq!(dirs.each_ref().map(|dir| contents(dir)), before);

    let staged: Vec<Staged> = dirs.iter().map(stage).collect();
    let paths = write_together(staged).unwrap();
    assert_eq!(paths[1], [dirs[1].join("a"), dirs[1].join("b")]);
    assert!(dirs.iter().all(|dir| is_sealed(dir) && !dir.join("gone").exists()));
}

/// A list of two files that both hold `2`.
fn of_two() -> Manifest {
    let stamp = |name: &str| (name.into(), Stamp::read(&b"2"[..]).unwrap());
    Manifest::new("simulate", ["a", "b"].map(stamp))
}

/// Between the two lists a power cut may fall: both the old and the new files are known then.
#[test]
fn a_cut_between_list_and_files_leaves_a_folder_that_a_rerun_knows() {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "simulate", &[("a", b"1"), ("b", b"1")], &[]).unwrap();
    let old = Manifest::read(dir.path()).unwrap();
    let both = old.with(&of_two());
    fs::write(dir.path().join(MANIFEST), both.text().unwrap()).unwrap();
    fs::write(dir.path().join("a"), "2").unwrap();
    write(dir.path(), "simulate", &[("a", b"3"), ("b", b"3")], &[]).unwrap();
    assert_eq!(fs::read(dir.path().join("b")).unwrap(), b"3");
}

/// A list that names files elsewhere must not make plydrape remove them.
#[test]
fn a_list_that_reaches_out_of_its_folder_is_refused() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path().join("out");
    fs::create_dir(&dir).unwrap();
    fs::write(home.path().join("victim"), "v").unwrap();
    let list = format!(r#"{{"../victim":[{{"crc32":{},"length":1}}]}}"#, crc32fast::hash(b"v"));
    fs::write(dir.join(MANIFEST), list).unwrap();
    assert!(write(&dir, "simulate", &[("a", b"1")], &[]).is_err());
    assert!(home.path().join("victim").exists());
    fs::write(dir.join(MANIFEST), "my own notes").unwrap();
    assert!(matches!(write(&dir, "simulate", &[("a", b"1")], &[]), Err(Error::Foreign { .. })));
    for name in ["", "..", "../a", "a/b", "/a", ".plydrape"] {
        assert!(write(home.path(), "simulate", &[(name, b"1")], &[]).is_err(), "{name:?}");
    }
}

/// A list that never ends is not read.
#[cfg(target_os = "linux")]
#[test]
fn a_list_that_is_a_device_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    std::os::unix::fs::symlink("/dev/zero", dir.path().join(MANIFEST)).unwrap();
    let fault = write(dir.path(), "simulate", &[("a", b"1")], &[]).unwrap_err();
    assert!(fault.to_string().contains("not a regular file"), "{fault}");
}

/// A link to a file elsewhere is not ours, whatever it leads to.
#[cfg(unix)]
#[test]
fn a_link_is_not_followed() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path().join("out");
    write(&dir, "simulate", &[("a", b"1")], &[]).unwrap();
    fs::rename(dir.join("a"), home.path().join("a")).unwrap();
    std::os::unix::fs::symlink(home.path().join("a"), dir.join("a")).unwrap();
    assert!(matches!(write(&dir, "simulate", &[("a", b"2")], &[]), Err(Error::Foreign { .. })));
}

/// A path that is a file, or runs through one, says so.
#[test]
fn a_path_that_is_a_file_is_refused_by_name() {
    let home = tempfile::tempdir().unwrap();
    let file = home.path().join("file");
    fs::write(&file, "f").unwrap();
    for path in [file.clone(), file.join("below")] {
        let fault = write(&path, "simulate", &[("a", b"1")], &[]).unwrap_err();
        assert!(matches!(fault, Error::NotAFolder { .. }), "{fault}");
    }
    assert_eq!(fs::read(&file).unwrap(), b"f");
}

/// Linux's `/proc` refuses new files to everyone, also to root, for whom a read-only folder is not one.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_takes_no_files_is_an_error_with_a_remedy() {
    let fault = write(Path::new("/proc/self"), "simulate", &[("a", b"1")], &[]).unwrap_err();
    assert!(fault.to_string().contains("/proc/self"), "{fault}");
    assert!(fault.to_string().contains("-o"), "{fault}");
}

proptest! {
    // Each case waits for the disk many times.
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Whatever runs and edits come in whatever order: a run that succeeds leaves exactly its files
    /// besides the user's, a run that fails changes nothing, and the user's files never change.
    #[test]
    fn runs_and_edits_in_any_order_lose_nothing(
        acts in proptest::collection::vec((any::<bool>(), 1u8..16, 0u8..3), 1..12)
    ) {
        let dir = tempfile::tempdir().unwrap();
        let all = ["a", "b", "c", "d"];
        let mut users: BTreeMap<String, Vec<u8>> = BTreeMap::new();
        for (k, (run, mask, content)) in acts.into_iter().enumerate() {
            // some of the four files: a run writes them all, an edit writes the first of them
            let chosen: Vec<&str> = (0..4).filter(|i| mask >> i & 1 == 1).map(|i| all[i]).collect();
            if run {
                // a run leaves its files beside those of the user, or all as it was
                let bytes = [content];
                let files: Vec<(&str, &[u8])> = chosen.iter().map(|n| (*n, &bytes[..])).collect();
                let before = contents(dir.path());
                match write(dir.path(), "simulate", &files, &[]) {
                    Ok(_) => {
                        let mut expected = users.clone();
                        expected.extend(chosen.iter().map(|n| ((*n).to_owned(), bytes.to_vec())));
                        let mut found = contents(dir.path());
                        found.remove(MANIFEST);
                        let found: BTreeMap<_, _> =
                            found.into_iter().map(|(n, c)| (n, c.unwrap())).collect();
                        prop_assert_eq!(found, expected);
                    }
                    Err(_) => prop_assert_eq!(contents(dir.path()), before),
                }
            } else {
                // an edit makes the file the user's own
                let mine = format!("mine {k}").into_bytes();
                fs::write(dir.path().join(chosen[0]), &mine).unwrap();
                users.insert(chosen[0].to_owned(), mine);
            }
        }
    }
}

/// Files that are added leave those of an earlier run in place, and both stay plydrape's own.
#[test]
fn added_files_stand_beside_earlier_ones() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    write(dir, "simulate", &[("a.csv", b"1"), ("b.csv", b"2")], &[]).unwrap();
    add(dir, "report", &[("c.csv", b"3"), ("b.csv", b"4")], &[]).unwrap();
    let read = |name: &str| std::fs::read(dir.join(name)).unwrap();
    assert_eq!([read("a.csv"), read("b.csv"), read("c.csv")], [b"1", b"4", b"3"]);
    std::fs::write(dir.join("c.csv"), "mine").unwrap();
    assert!(matches!(add(dir, "report", &[("c.csv", b"5")], &[]), Err(Error::Foreign { .. })));
    add(dir, "report", &[("b.csv", b"6")], &[]).unwrap();
    write(dir, "simulate", &[("d.csv", b"7")], &[]).unwrap();
    // the one that the other command has replaced is that command's now
    assert!(!dir.join("a.csv").exists());
    assert_eq!([&read("b.csv")[..], &read("c.csv")[..]], [&b"6"[..], &b"mine"[..]]);
}

/// A second run is refused while the first holds its claim, and hears who that is; afterwards it may write.
#[test]
fn a_claimed_folder_is_refused_with_who_holds_it() {
    let dir = tempfile::tempdir().unwrap();
    let first = Folder::claim(dir.path(), "simulate", &[]).unwrap();
    let Err(fault) = Folder::claim(dir.path(), "plan", &[]) else { panic!("two claims") };
    let said = fault.to_string();
    assert!(said.contains("`plydrape simulate`"), "{said}");
    assert!(said.contains(&std::process::id().to_string()), "{said}");
    drop(first);
    Folder::claim(dir.path(), "plan", &[]).unwrap().write(&[("a", &b"1"[..])]).unwrap();
}

/// A file that is put by while a run goes on is there at once and after the run was killed; it takes the place of the one before, and goes when
/// the run writes its files, whatever a folder held before.
#[test]
fn what_is_put_by_stays_until_the_files_come() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path().join("out");
    write(&dir, "plan", &[("result.json", b"before")], &[]).unwrap();
    let put_by = |folder: &Folder, content: &'static [u8]| folder.put_by("search.json", &content);
    let folder = Folder::claim(&dir, "plan", &[]).unwrap();
    put_by(&folder, b"first").unwrap();
    put_by(&folder, b"second").unwrap();
    assert_eq!(fs::read(dir.join("search.json")).unwrap(), b"second");
    assert!(is_sealed(&dir));
    // as if it was killed: nothing is dropped
    let Folder { stage, _lock, .. } = &folder;
    assert!(stage.is_some());
    drop(_lock.unlock());
    std::mem::forget(folder);
    let next = Folder::claim(&dir, "plan", &[]).unwrap();
    assert_eq!(fs::read(dir.join("search.json")).unwrap(), b"second");
    assert_eq!(fs::read(dir.join("result.json")).unwrap(), b"before");
    put_by(&next, b"third").unwrap();
    next.write(&[("result.json", &b"after"[..])]).unwrap();
    assert_eq!(names(&dir), [".plydrape", "result.json"]);

    let last = Folder::claim(&dir, "plan", &[]).unwrap();
    put_by(&last, b"fourth").unwrap();
    last.remove("search.json").unwrap();
    drop(last);
    assert_eq!(names(&dir), [".plydrape", "result.json"]);
    fs::write(dir.join("search.json"), "mine").unwrap();
    let folder = Folder::claim(&dir, "plan", &[]).unwrap();
    assert!(matches!(put_by(&folder, b"fifth"), Err(Error::Foreign { .. })));
}

/// What was staged for one folder comes into another one, with its list; the first one is as it was.
#[test]
fn staged_files_can_go_to_another_folder() {
    let home = tempfile::tempdir().unwrap();
    let [one, two] = ["one", "two"].map(|name| home.path().join(name));
    write(&one, "plan", &[("a", b"1")], &[]).unwrap();
    let before = contents(&one);
    let staged = Folder::claim(&one, "plan", &[]).unwrap();
    let staged = staged.stage_files(&[("a", &b"2"[..]), ("b", &b"2"[..])]).unwrap();
    let paths = staged.moved_to(Folder::claim(&two, "plan", &[]).unwrap()).unwrap().write();
    assert_eq!(paths.unwrap(), [two.join("a"), two.join("b")]);
    assert_eq!(contents(&one), before);
    assert_eq!(names(&two), [".plydrape", "a", "b"]);
    write(&two, "plan", &[("b", b"3")], &[]).unwrap();
    assert_eq!(names(&two), [".plydrape", "b"]);
}

/// A claim that writes nothing leaves nothing, not even the folder that it made.
#[test]
fn a_claim_without_files_leaves_nothing() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path().join("out");
    drop(Folder::claim(&dir, "simulate", &[]).unwrap());
    assert!(!dir.exists());
}

/// What a run that was killed has staged is cleared, also one that had nothing yet or nothing any more; a folder of the user's with such a
/// name stays.
#[test]
fn stages_of_dead_runs_are_cleared() {
    let dir = tempfile::tempdir().unwrap();
    let (dead, mine) = (dir.path().join(".plydrape-dead"), dir.path().join(".plydrape-mine"));
    let empty = dir.path().join(".plydrape-empty");
    fs::create_dir(&empty).unwrap();
    for folder in [&dead, &mine] {
        fs::create_dir(folder).unwrap();
        fs::write(folder.join("new-result.json"), "half").unwrap();
    }
    fs::write(dead.join(OWNER), "`plydrape simulate`, process 1").unwrap();
    write(dir.path(), "simulate", &[("a", b"1")], &[]).unwrap();
    assert!(!dead.exists() && !empty.exists() && mine.exists());
}

/// What a link with the name of a stage leads to is not cleared, even where it holds a file with the name of an owner's.
#[cfg(unix)]
#[test]
fn a_link_with_the_name_of_a_stage_is_not_followed() {
    let home = tempfile::tempdir().unwrap();
    let [dir, mine] = ["out", "mine"].map(|name| home.path().join(name));
    for folder in [&dir, &mine] {
        fs::create_dir(folder).unwrap();
    }
    fs::write(mine.join(OWNER), "me").unwrap();
    std::os::unix::fs::symlink(&mine, dir.join(".plydrape-link")).unwrap();
    write(&dir, "simulate", &[("a", b"1")], &[]).unwrap();
    assert_eq!(names(&mine), [OWNER]);
}

/// A kill between two renames leaves a list without a seal; a whole run seals it again, an addition does not.
#[test]
fn the_seal_comes_last() {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "simulate", &[("a", b"1"), ("b", b"1")], &[]).unwrap();
    assert!(is_sealed(dir.path()));
    let both = Manifest::read(dir.path()).unwrap();
    let both = both.with(&of_two());
    fs::write(dir.path().join(MANIFEST), both.text().unwrap()).unwrap();
    fs::write(dir.path().join("a"), "2").unwrap();
    assert!(!is_sealed(dir.path()));
    add(dir.path(), "report", &[("c", b"3")], &[]).unwrap();
    assert!(!is_sealed(dir.path()));
    write(dir.path(), "simulate", &[("a", b"3"), ("b", b"3")], &[]).unwrap();
    assert!(is_sealed(dir.path()));
}

/// An addition that was killed between two renames is sealed by the same addition, because nothing else is mixed then.
#[test]
fn an_addition_that_was_killed_is_sealed_by_its_next_run() {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "simulate", &[("a", b"1")], &[]).unwrap();
    let both = Manifest::read(dir.path()).unwrap().with(&of_two());
    // of a and b, b alone is new: it is not there yet
    fs::write(dir.path().join(MANIFEST), both.text().unwrap()).unwrap();
    add(dir.path(), "report", &[("c", b"3")], &[]).unwrap();
    assert!(!is_sealed(dir.path()));
    add(dir.path(), "export", &[("a", b"2"), ("b", b"2")], &[]).unwrap();
    assert!(is_sealed(dir.path()));
}

/// A command removes old files of its own only, and nothing that the run has read.
#[test]
fn old_files_of_other_commands_and_inputs_stay() {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "plan", &[("result.json", b"1"), ("plan.json", b"1"), ("old", b"1")], &[])
        .unwrap();
    write(dir.path(), "simulate", &[("result.json", b"2"), ("more", b"2"), ("in", b"2")], &[])
        .unwrap();
    assert_eq!(names(dir.path()), [".plydrape", "in", "more", "old", "plan.json", "result.json"]);
    let read = [dir.path().join("in")];
    let folder = Folder::claim(dir.path(), "simulate", &read).unwrap();
    assert!(matches!(folder.refuse_taken(&["a", "in"]), Err(Error::Input { .. })));
    folder.refuse_taken(&["a"]).unwrap();
    folder.write(&[("result.json", &b"3"[..])]).unwrap();
    assert_eq!(names(dir.path()), [".plydrape", "in", "old", "plan.json", "result.json"]);
}
