//! What a file is, by how it begins, where another one was expected; and which file was meant by a name that is none.

use crate::store::format::FORMAT;
use std::path::Path;

/// What a file can be that is taken for another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FileKind {
    Stl,
    Obj,
    Abaqus,
    Step,
    Iges,
    Dxf,
    Table,
    Result,
    Json,
    Scene,
    Picture,
    Pdf,
    Zip,
    Page,
}

/// Bytes at the beginning that are looked at.
const HEAD: usize = 4096;

impl FileKind {
    /// The kind of a file, if its bytes tell.
    pub fn detect(bytes: &[u8]) -> Option<FileKind> {
        Self::of_start(bytes, bytes.len() as u64)
    }

    /// The kind of a file of `size` bytes, by its beginning.
    pub fn of_start(bytes: &[u8], size: u64) -> Option<FileKind> {
        let size = size - if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let binary = [
            (&b"\x89PNG"[..], FileKind::Picture),
            (b"\xff\xd8\xff", FileKind::Picture),
            (b"GIF8", FileKind::Picture),
            (b"RIFF", FileKind::Picture),
            (b"%PDF", FileKind::Pdf),
            (b"PK\x03\x04", FileKind::Zip),
            (b"AutoCAD Binary DXF", FileKind::Dxf),
        ];
        if let Some((_, kind)) = binary.iter().find(|(start, _)| bytes.starts_with(start)) {
            return Some(*kind);
        }
        // 80 bytes of anything, the number of triangles, and 50 bytes of each
        if let Some(count) = bytes.get(80..84).and_then(|count| count.try_into().ok()) {
            let triangles = u64::from(u32::from_le_bytes(count));
            if triangles > 0 && size == 84 + 50 * triangles {
                return Some(FileKind::Stl);
            }
        }
        let head = &bytes[..bytes.len().min(HEAD)];
        if head.contains(&0) {
            // no text has a zero
            return None;
        }
        Self::of_text(&String::from_utf8_lossy(head))
    }

    fn of_text(text: &str) -> Option<FileKind> {
        let lines = || text.lines().map(str::trim_end).filter(|line| !line.trim().is_empty());
        let first = lines().next()?;
        let said = lines().find(|line| !line.trim_start().starts_with('#')).unwrap_or(first);
        let start = first.trim_start().to_ascii_lowercase();
        let word = said.split_whitespace().next().unwrap_or_default();
        // before a scene: its scripts and styles may have lines that look like keys
        if start.starts_with("<!doctype html") || start.starts_with("<html") {
            return Some(FileKind::Page);
        }
        // a scene before all that a line of it may look like
        if lines().any(|line| is_key(line) || is_header(line)) {
            return Some(FileKind::Scene);
        }
        if start.starts_with("iso-10303") {
            Some(FileKind::Step)
        } else if first.len() == 80 && first.as_bytes()[72] == b'S' {
            Some(FileKind::Iges)
        } else if start.starts_with("solid") && text.contains("facet") {
            Some(FileKind::Stl)
        } else if start.trim() == "0" && lines().nth(1).is_some_and(|line| line.trim() == "SECTION")
        {
            Some(FileKind::Dxf)
        } else if matches!(word, "v" | "vn" | "vt" | "mtllib" | "o" | "g") {
            Some(FileKind::Obj)
        } else if said.starts_with('*') {
            Some(FileKind::Abaqus)
        } else if start.starts_with('{') {
            let bare: String = text.chars().take(200).filter(|c| !c.is_whitespace()).collect();
            let ours = bare.starts_with(&format!("{{\"format\":\"{FORMAT}\""));
            Some(if ours { FileKind::Result } else { FileKind::Json })
        } else if start.starts_with("<svg") {
            Some(FileKind::Picture)
        } else if is_table(lines().filter(|line| !line.trim_start().starts_with('#'))) {
            Some(FileKind::Table)
        } else {
            None
        }
    }

    /// Name with an article.
    pub fn name(self) -> &'static str {
        match self {
            FileKind::Stl => "a mesh (STL)",
            FileKind::Obj => "a mesh (OBJ)",
            FileKind::Abaqus => "a mesh or a deck (Abaqus)",
            FileKind::Step => "a CAD model (STEP)",
            FileKind::Iges => "a CAD model (IGES)",
            FileKind::Dxf => "a drawing (DXF)",
            FileKind::Table => "a table (CSV)",
            FileKind::Result => "a result of plydrape",
            FileKind::Json => "a JSON file",
            FileKind::Scene => "a scene or another TOML file",
            FileKind::Picture => "a picture",
            FileKind::Pdf => "a PDF",
            FileKind::Zip => "a ZIP archive or a spreadsheet",
            FileKind::Page => "a web page",
        }
    }

    /// Remedy where a scene was expected.
    pub fn in_place_of_a_scene(self, name: &str) -> String {
        match self {
            FileKind::Stl | FileKind::Obj | FileKind::Abaqus => format!(
                "name it in a scene, as in [mold] kind = \"mesh\", file = \"{name}\", unit = \"mm\"; `plydrape new NAME` writes a scene to start from"
            ),
            FileKind::Step | FileKind::Iges => "export the surface that the ply lies on as an STL or OBJ file and name that in [mold] of a scene, or read it with `plydrape.cad` in Python; `plydrape new NAME` writes a scene to start from".into(),
            FileKind::Dxf => format!(
                "name it in a scene, as in [ply] outline = \"{name}\"; `plydrape new NAME` writes a scene to start from"
            ),
            FileKind::Table => "a scene names it: as `positions` in [grippers], as `file` in [motion], or as `file` of a mold of kind \"height-grid\"; `plydrape new NAME` writes a scene to start from".into(),
            FileKind::Result => format!(
                "`plydrape report {name}` and `plydrape export {name} --to FORMAT` take it; a scene is the .toml file that it was made from"
            ),
            _ => "give the .toml file of a scene; `plydrape new NAME` writes one to start from".into(),
        }
    }
}

/// `[name]` or `[[name]]` in a line of its own.
fn is_header(line: &str) -> bool {
    let line = line.split('#').next().unwrap_or_default().trim();
    let name = line.strip_prefix('[').and_then(|line| line.strip_suffix(']'));
    name.is_some_and(|name| !name.is_empty() && !name.contains([',', ' ', '"']))
}

/// `key = value`.
fn is_key(line: &str) -> bool {
    line.split_once('=').is_some_and(|(key, value)| {
        let key = key.trim();
        let plain = |c: char| c.is_ascii_alphanumeric() || "_-.".contains(c);
        !key.is_empty() && key.chars().all(plain) && !value.trim().is_empty()
    })
}

/// Rows of the same number of fields, more than one, between the same separators; of prose the commas differ from line to line.
fn is_table<'a>(lines: impl Iterator<Item = &'a str>) -> bool {
    let first: Vec<&str> = lines.take(3).collect();
    [',', ';', '\t'].into_iter().any(|separator| {
        let mut counts = first.iter().map(|line| line.split(separator).count());
        counts.next().is_some_and(|count| count > 1 && counts.all(|other| other == count))
    })
}

/// Letters that are put in, left out, changed or exchanged with their neighbors between two words, capitals apart.
pub(crate) fn edits(a: &str, b: &str) -> usize {
    let small = |word: &str| word.chars().take(64).flat_map(char::to_lowercase).collect::<String>();
    strsim::osa_distance(&small(a), &small(b))
}

/// Most entries of a folder that are looked at.
const ENTRIES: usize = 10_000;

/// The name in its folder that is nearest to a path that leads nowhere, in place of the path's own.
pub(crate) fn nearest_name(path: &Path) -> Option<String> {
    let wanted = path.file_name()?.to_str()?;
    let folder = path.parent().filter(|folder| *folder != Path::new(""));
    let entries = std::fs::read_dir(folder.unwrap_or(Path::new("."))).ok()?;
    let names =
        entries.take(ENTRIES).filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let stem = |name: &str| name.rsplit_once('.').map_or(name, |(stem, _)| stem).to_lowercase();
    let near = |name: &String| {
        let distance = edits(wanted, name);
        // the ending is the same in many names
        let close = distance <= ((1 + stem(wanted).chars().count()) / 3).max(1);
        (close || stem(name) == stem(wanted)).then_some(distance)
    };
    let found = names.filter_map(|name| Some((near(&name)?, name))).min()?.1;
    let found = folder.map_or_else(|| found.clone().into(), |folder| folder.join(&found));
    Some(found.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_known_by_how_they_begin() {
        let mut stl = vec![0; 84 + 50];
        stl[80] = 1;
        let cases: [(&[u8], Option<FileKind>); 18] = [
            (b"<!doctype html>\n<style>\nwidth = 3\n", Some(FileKind::Page)),
            (b"# A title\n\nProse, with a comma.\nA line without one.\n", None),
            (b"\0\x01,\x02;\0", None),
            (&stl, Some(FileKind::Stl)),
            (b"solid x\n facet normal 0 0 1\n", Some(FileKind::Stl)),
            (b"# made by hand\nv 0 0 0\nv 1 0 0\n", Some(FileKind::Obj)),
            (b"*HEADING\n*NODE\n1, 0., 0., 0.\n", Some(FileKind::Abaqus)),
            (b"ISO-10303-21;\nHEADER;\n", Some(FileKind::Step)),
            (b"  0\nSECTION\n  2\n", Some(FileKind::Dxf)),
            (b"i,j,x (mm),y (mm),z (mm)\n0,0,0,0,0\n", Some(FileKind::Table)),
            (b"{ \"format\": \"plydrape-result\", \"version\": 8,", Some(FileKind::Result)),
            (b"{}", Some(FileKind::Json)),
            (b"\x89PNG\r\n\x1a\n", Some(FileKind::Picture)),
            (b"PK\x03\x04", Some(FileKind::Zip)),
            (b"# a scene\n[ply]\ngrippers = [4, 2]\n", Some(FileKind::Scene)),
            (b"title = \"a, b\"\n", Some(FileKind::Scene)),
            (b"", None),
            (b"hello\n", None),
        ];
        for (bytes, kind) in cases {
            assert_eq!(FileKind::detect(bytes), kind, "{}", String::from_utf8_lossy(bytes));
        }
    }

    /// A large file is known by its first bytes and its size.
    #[test]
    fn a_mesh_is_known_by_its_beginning() {
        let mut head = [0; 4096];
        head[80] = 200;
        assert_eq!(FileKind::of_start(&head, 84 + 50 * 200), Some(FileKind::Stl));
        assert_eq!(FileKind::of_start(&head, 84 + 50 * 200 - 1), None);
    }

    #[test]
    fn a_name_that_is_none_finds_the_nearest_in_its_folder() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("scene.toml"), "").unwrap();
        std::fs::write(folder.path().join("mold.STL"), "").unwrap();
        let near = |name: &str| {
            let found = nearest_name(&folder.path().join(name))?;
            Some(Path::new(&found).file_name()?.to_string_lossy().into_owned())
        };
        assert_eq!(near("scnee.toml").as_deref(), Some("scene.toml"));
        assert_eq!(near("scene.tml").as_deref(), Some("scene.toml"));
        assert_eq!(near("mold.stl").as_deref(), Some("mold.STL"));
        assert_eq!(near("other.csv"), None);
        assert_eq!(nearest_name(Path::new("/nowhere/at all/x")), None);
    }

    /// Counted by hand.
    #[test]
    fn edits_are_letters_put_in_left_out_changed_or_exchanged() {
        assert_eq!(edits("gripers", "grippers"), 1);
        assert_eq!(edits("Cell", "cell"), 0);
        assert_eq!(edits("kitten", "sitting"), 3);
        assert_eq!(edits("falt.obj", "flat.obj"), 1);
    }
}
