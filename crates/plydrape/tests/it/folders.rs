//! A folder is a stage of the method: it imports the folders before it, and none after it. Files beside `lib.rs` count as folders.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The folders of each crate, from the bottom to the top.
const CRATES: [(&str, &str); 8] = [
    (
        "block-cholesky",
        "error tuning block_matrix graph kernel supernode front assembly analysis restriction substitution cholesky",
    ),
    (
        "plydrape-layup",
        "gripper error stopwatch geometry mold material ply net motion bodies arm tool layup clearance placement state",
    ),
    ("plydrape-catenary", "error catenary elastica equilibrium draping sensitivity stepwise"),
    ("plydrape", "error fit sheet pick_up measure errors scene outcome planner"),
    (
        "plydrape-io",
        "error store read result scene text write robot peer page export fit plan replan rerun sample",
    ),
    (
        "plydrape-cli",
        "failure argument mesh outcome results numbers watch search errors model plan check compare complete export new fit limits net \
         replan report schema simulate span study template",
    ),
    (
        "plydrape-py",
        "arrays error json quantity work mold net table ply scene model beside limits sample sheet surface result drape measure \
         stations jacobian equilibrium solver span outcome batch pickle fit",
    ),
    ("plydrape-live", "answer boundary"),
];

/// The identifiers in a text.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// The code of a file without comments and tests.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or("");
    text.lines().map(|line| line.split("//").next().unwrap_or("").to_owned() + "\n").collect()
}

/// The code of every file in a folder, or of a file, but for tests; paths from the root of the crate begin with `crate`.
fn codes(path: &Path, root: &Path) -> Vec<String> {
    let stem = path.file_stem().unwrap().to_string_lossy();
    let folder = if stem == "mod" { path.parent() } else { Some(path) };
    let at_root = folder.and_then(Path::parent) == Some(root);
    match path.is_dir() {
        _ if stem.ends_with("tests") => Vec::new(),
        true => {
            let entries = fs::read_dir(path).unwrap();
            entries.flat_map(|entry| codes(&entry.unwrap().path(), root)).collect()
        }
        false if at_root => vec![code(path).replace("super::", "crate::")],
        false => vec![code(path)],
    }
}

/// What a code imports from its crate: the first name of each path, or of each in a list.
fn imports(code: &str) -> impl Iterator<Item = &str> {
    code.split("crate::").skip(1).flat_map(|path| {
        let list = path.strip_prefix('{').and_then(|list| list.split('}').next());
        let count = if list.is_some() { usize::MAX } else { 1 };
        list.unwrap_or(path).split(',').take(count).filter_map(|path| words(path).next())
    })
}

/// No folder imports one that comes after it, by a path or by a name that the root of the crate hands on; and no folder is without a place.
#[test]
fn a_folder_imports_those_before_it() {
    for (name, order) in CRATES {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name(name).join("src");
        let places: BTreeMap<&str, usize> = order.split_whitespace().zip(0..).collect();
        let head = ["lib.rs", "main.rs"].map(|file| root.join(file));
        let head = code(head.iter().find(|path| path.exists()).unwrap());
        let statements = head.split("pub use ").skip(1).filter_map(|text| text.split(';').next());
        let handed_on: BTreeMap<&str, &str> = statements
            .flat_map(|text| {
                words(text).skip(1).map(move |word| (word, words(text).next().unwrap()))
            })
            .collect();
        let mut without = places.clone();
        for path in fs::read_dir(&root).unwrap().map(|entry| entry.unwrap().path()) {
            let stem = path.file_stem().unwrap().to_string_lossy();
            if ["lib", "main"].contains(&&*stem) || stem.ends_with("tests") {
                continue;
            }
            let own = places.get(&*stem).unwrap_or_else(|| panic!("{name}: {stem} has no place"));
            without.remove(&*stem);
            for code in codes(&path, &root) {
                for import in imports(&code) {
                    let folder = handed_on.get(import).unwrap_or(&import);
                    let before = places.get(folder).is_none_or(|place| place <= own);
                    assert!(before, "{name}: {stem} imports {folder}, which comes after it");
                }
            }
        }
        assert!(without.is_empty(), "{name}: {without:?} is no folder");
    }
}
