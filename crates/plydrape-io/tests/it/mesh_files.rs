//! Mesh files: every format as it should be, repairs that are reported, and broken files with the messages
//! they get.

use plydrape::mold::Pose;
use plydrape::mold::mesh::{Mesh, MeshReport, Role};
use plydrape_io::Error;
use std::path::Path;

type Point = [f64; 3];

/// A fault and its remedy on one line.
fn message(fault: &Error) -> String {
    format!("{fault}; {}\n", fault.help())
}

fn parse(file: &str, contents: impl AsRef<[u8]>) -> Result<(Mesh, MeshReport), Error> {
    plydrape_io::read::mesh::parse(file, contents.as_ref(), 1.0, &Pose::ORIGIN, 0.0)
}

fn read(file: &str, contents: impl AsRef<[u8]>) -> (Mesh, MeshReport) {
    parse(file, contents).unwrap_or_else(|e| panic!("{e}"))
}

/// Vertices in the order of their coordinates.
fn sorted(mesh: &Mesh) -> Vec<Point> {
    let mut vertices = mesh.vertices().to_vec();
    vertices.sort_by(|a, b| a.partial_cmp(b).unwrap());
    vertices
}

fn close(a: &[Point], b: &[Point], tolerance: f64) {
    assert_eq!(a.len(), b.len(), "{a:?} {b:?}");
    for (p, q) in a.iter().zip(b) {
        assert!((0..3).all(|n| (p[n] - q[n]).abs() <= tolerance), "{p:?} {q:?}");
    }
}

/// Two triangles over the unit square, at height 0.25.
const SQUARE: [[Point; 3]; 2] = [
    [[0.0, 0.0, 0.25], [1.0, 0.0, 0.25], [1.0, 1.0, 0.25]],
    [[0.0, 0.0, 0.25], [1.0, 1.0, 0.25], [0.0, 1.0, 0.25]],
];

const CORNERS: [Point; 4] =
    [[0.0, 0.0, 0.25], [0.0, 1.0, 0.25], [1.0, 0.0, 0.25], [1.0, 1.0, 0.25]];

/// Binary STL as written by another program's library.
fn binary(triangles: &[[Point; 3]]) -> Vec<u8> {
    let triangles: Vec<stl_io::Triangle> = triangles
        .iter()
        .map(|corners| stl_io::Triangle {
            normal: stl_io::Normal::new([0.0, 0.0, 1.0]),
            vertices: corners.map(|p| stl_io::Vertex::new(p.map(|x| x as f32))),
        })
        .collect();
    let mut bytes = Vec::new();
    stl_io::write_stl(&mut bytes, triangles.iter()).unwrap();
    bytes
}

fn ascii(triangles: &[[Point; 3]]) -> String {
    let mut text = "solid part of a mold\n".to_owned();
    for corners in triangles {
        text += "  facet normal 0 0 1\n    outer loop\n";
        for [x, y, z] in corners {
            text += &format!("      vertex {x:e} {y} {z:?}\n");
        }
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid part of a mold\n"
}

#[test]
fn stl_is_read_as_text_and_as_binary() {
    for (mesh, report) in [
        read("a.stl", binary(&SQUARE)),
        read("a.STL", ascii(&SQUARE)),
        read("a.stl", ascii(&SQUARE).to_uppercase().replace('\n', "\r\n")),
    ] {
        close(&sorted(&mesh), &CORNERS, 0.0);
        assert_eq!((report.triangles, report.vertices, report.surfaces), (2, 4, 1));
        assert_eq!(report.to_string().lines().count(), 1, "nothing was repaired: {report}");
        assert!((mesh.closest_point([0.5, 0.5, 1.0]).distance - 0.75).abs() < 1e-15);
    }
}

/// Eighty bytes of header may hold anything, the word of a text file too.
#[test]
fn a_binary_stl_that_begins_with_solid_is_binary() {
    let mut bytes = binary(&SQUARE);
    bytes[..11].copy_from_slice(b"solid mold\n");
    close(&sorted(&read("a.stl", bytes).0), &CORNERS, 0.0);
}

/// Text keeps what 32 bits would lose.
#[test]
fn text_stl_keeps_every_digit() {
    let mut triangles = SQUARE;
    triangles[0][1][0] = 1.000_000_000_000_1;
    let (mesh, _) = read("a.stl", ascii(&triangles));
    assert!(mesh.vertices().iter().any(|p| p[0] == 1.000_000_000_000_1));
}

#[test]
fn several_solids_in_one_text_file_are_one_mold() {
    let text = ascii(&SQUARE[..1]) + "\n" + &ascii(&SQUARE[1..]);
    assert_eq!(read("a.stl", text).1.triangles, 2);
}

#[test]
fn obj_is_read_with_polygons_negative_indices_and_all_that_stands_beside() {
    let texts = [
        "v 0 0 .25\nv 1 0 .25\nv 1 1 .25\nv 0 1 .25\nf 1 2 3 4\n",
        "# a comment\nmtllib x.mtl\no mold\ng top\nv 0 0 .25\nv 1 0 .25\nv 1 1 .25\nv 0 1 .25\n\
         vt 0 0\nvn 0 0 1\nusemtl steel\ns off\nf 1/1/1 2/1/1 3//1 # a face\nf -4 -2 \\\n -1\nl 1 2\n",
        "f 1 2 3\nv 0 0 .25 1\nv 2 0 .5 2\nv 1 1 .25 0.1 0.2 0.3\nf -3 -1 4\nv 0 1 .25",
    ];
    for text in texts {
        let (mesh, report) = read("a.obj", text);
        close(&sorted(&mesh), &CORNERS, 0.0);
        assert_eq!(report.triangles, 2);
        assert_eq!(report.to_string().lines().count(), 1, "nothing was repaired: {report}");
    }
}

/// A wavy sheet, read by `tobj` and `stl_io`: the same vertices and as many triangles.
#[test]
fn the_readers_agree_with_those_of_other_programs() {
    let vertex = |n: usize| {
        let (x, y) = ((n % 6) as f64 / 7.0, (n / 6) as f64 / 9.0);
        [x, y, 0.1 * (5.0 * x + 3.0 * y).sin()].map(|x| f64::from(x as f32))
    };
    let (mut obj, mut triangles) = (String::new(), Vec::new());
    (0..36).map(vertex).for_each(|[x, y, z]| obj += &format!("v {x:?} {y:?} {z:?}\n"));
    for n in (0..30).filter(|n| n % 6 < 5) {
        obj += &format!("f {} {} {} {}\n", n + 1, n + 2, n + 8, n + 7);
        triangles.extend([[n, n + 1, n + 7], [n, n + 7, n + 6]].map(|t| t.map(vertex)));
    }
    let ours = read("a.obj", &obj).0;
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let nothing = |_: &Path| Ok((Vec::new(), Default::default()));
    let peer = tobj::load_obj_buf(&mut obj.as_bytes(), &options, nothing).unwrap().0;
    assert_eq!(peer[0].mesh.indices.len(), 3 * ours.triangles().len());
    let mut vertices = peer[0].mesh.positions.as_chunks::<3>().0.to_vec();
    vertices.sort_by(|a, b| a.partial_cmp(b).unwrap());
    close(&sorted(&ours), &vertices, 0.0);

    for bytes in [binary(&triangles), ascii(&triangles).into_bytes()] {
        let ours = read("a.stl", &bytes).0;
        let peer = stl_io::read_stl(&mut std::io::Cursor::new(bytes)).unwrap();
        assert_eq!(peer.faces.len(), ours.triangles().len());
        let mut vertices: Vec<Point> = peer.vertices.iter().map(|p| p.0.map(f64::from)).collect();
        vertices.sort_by(|a, b| a.partial_cmp(b).unwrap());
        close(&sorted(&ours), &vertices, 0.0);
    }
}

const PART: &str = "*Heading\n** a comment\n*Preprint, echo=NO\n*Part, name=Skin\n*Node\n\
    1, 0., 0., 0.\n 2, 1., 0., 0.\n 3, 1.D0, 1., 0.\n 4, 0., 1., 0.,\n 9, 5., 5., 5.\n\
    *Element, type=R3D4\n7, 1, 2, 3, 4\n*Nset, nset=Ref, internal\n9,\n*End Part\n*Assembly, name=A\n";

fn assembly(instances: &str) -> String {
    format!("{PART}{instances}*Node\n1, 0., 0., 0.\n*End Assembly\n*Step\n*End Step\n")
}

/// The node that nothing uses, a reference point, is left out.
#[test]
fn an_abaqus_part_stands_where_its_instance_puts_it() {
    let (mesh, report) = read("a.inp", assembly("*Instance, name=S-1, part=SKIN\n*End Instance\n"));
    assert_eq!((report.triangles, report.vertices), (2, 4));
    let flat: [Point; 4] = [[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    close(&sorted(&mesh), &flat, 0.0);

    let moved = "*Instance, name=S-1, part=Skin\n 0.5, 0., 2.\n*End Instance\n";
    let expected = flat.map(|[x, y, z]| [x + 0.5, y, z + 2.0]);
    close(&sorted(&read("a.inp", assembly(moved)).0), &expected, 0.0);
}

/// A quarter turn about a vertical axis through (1, 0, 0), after the move by (1, 0, 0): (x, y) comes to
/// (1 − y, x). The second instance hangs on the first after half a turn about the line x = 1, z = 0.
#[test]
fn instances_are_moved_first_and_then_turned() {
    let turned = "*Instance, name=S-1, part=Skin\n1., 0., 0.\n1., 0., 0., 1., 0., 1., 90.\n\
                  *End Instance\n";
    let (mesh, _) = read("a.inp", assembly(turned));
    let expected: [Point; 4] = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    close(&sorted(&mesh), &expected, 1e-15);

    let two = "*Instance, name=S-1,\n part=Skin\n*End Instance\n*INSTANCE, NAME=S-2, PART=Skin\n\
               , , \n1, 0, 0, 1, 5, 0, 180\n*END INSTANCE\n";
    let (mesh, report) = read("a.inp", assembly(two));
    assert_eq!((report.triangles, report.vertices, report.surfaces), (4, 6, 1));
    assert_eq!(mesh.bounds()[1].map(|x| (x * 1e12).round() / 1e12), [2.0, 1.0, 0.0]);
}

/// A file without parts; quadrilaterals split along the shorter diagonal; elements over two lines;
/// mid-side nodes passed over; what is no surface left out and reported.
#[test]
fn a_flat_abaqus_file_is_read() {
    let text = "*NODE, NSET=ALL\n1, 0, 0, 0\n2, 1, 0, 0\n3, 3, 1, 0\n4, 0, 1, 0\n5, 0, 2, 0\n\
                6, 9, 9, 9\n*ELEMENT, TYPE=S4R, ELSET=E\n1, 1, 2, 3, 4\n\
                *ELEMENT, TYPE=STRI65\n2, 4, 3, 5,\n 6, 6, 6\n*ELEMENT, TYPE=MASS\n3, 6\n";
    let (mesh, report) = read("a.inp", text);
    assert_eq!((report.triangles, report.vertices), (3, 5));
    let [mass] = &report.skipped[..] else { panic!("{:?}", report.skipped) };
    assert_eq!((mass.kind.as_str(), mass.count, mass.role), ("MASS", 1, Role::NoSurface));
    assert!(
        report.to_string().ends_with("elements of type MASS, which are no surface, left out: 1")
    );
    assert!(report.warnings().is_empty());
    let index_of = |p: Point| mesh.vertices().iter().position(|q| *q == p).unwrap() as u32;
    let diagonal = [index_of([1.0, 0.0, 0.0]), index_of([0.0, 1.0, 0.0])];
    let along = mesh.triangles().iter().filter(|t| diagonal.iter().all(|n| t.contains(n))).count();
    assert_eq!(along, 2);
}

/// A plate of 600 × 600 mm of one S8R and two triangles of second order, as CalculiX has them.
fn second_order_plate(triangles: &str) -> String {
    format!(
        "*NODE\n1, -300., -300., 0.\n2, 0., -300., 0.\n3, 300., -300., 0.\n4, -300., 300., 0.\n\
         5, 0., 300., 0.\n6, 300., 300., 0.\n7, -150., -300., 0.\n8, 150., -300., 0.\n\
         9, 300., 0., 0.\n10, 150., 300., 0.\n11, -150., 300., 0.\n12, -300., 0., 0.\n\
         13, 0., 0., 0.\n14, -150., 0., 0.\n*ELEMENT, TYPE=S8R, ELSET=SKIN\n\
         1, 2, 3, 6, 5, 8, 9, 10, 13\n*ELEMENT, TYPE={triangles}, ELSET=SKIN\n\
         2, 1, 2, 5, 7, 13, 14\n3, 1, 5, 4, 14, 11, 12\n"
    )
}

/// Triangles of second order are read by their corners, under every name that programs give them.
#[test]
fn triangles_of_second_order_are_part_of_the_surface() {
    for kind in ["S6", "STRI65", "M3D6", "CPS6"] {
        let (mesh, report) = read("a.inp", second_order_plate(kind));
        assert_eq!((report.triangles, report.surfaces, report.skipped.len()), (4, 1, 0), "{kind}");
        assert_eq!(mesh.bounds(), [[-300.0, -300.0, 0.0], [300.0, 300.0, 0.0]]);
    }
}

/// Elements that are left out beside shells leave a hole, which is said with their number, type and place; those that
/// share no edge may be no part of the surface, and a solid below the shells is none.
#[test]
fn elements_left_out_beside_shells_are_warned_of() {
    let text = second_order_plate("SHELL6");
    let (_, report) = read("a.inp", &text);
    let [warning] = &report.warnings()[..] else { panic!("{:?}", report.warnings()) };
    assert!(warning.starts_with("2 of the mold's elements are of type SHELL6, a type that is not known here, and left out; 1 of these share an edge with its surface"), "{warning}");
    // the middle of element 2, in a file of meters
    assert!(warning.contains("near (-100000, -100000, 0) mm"), "{warning}");

    let text = second_order_plate("SC6R");
    let (_, report) = read("a.inp", &text);
    assert!(report.to_string().contains("type SC6R, which have two surfaces, left out: 2"));
    assert!(report.warnings()[0].contains("the mold has a hole"));

    let far = "*NODE\n21, 0, 0, 9\n22, 1, 0, 9\n23, 0, 1, 9\n*ELEMENT, TYPE=TRIA\n9, 21, 22, 23\n";
    let (_, report) = read("a.inp", second_order_plate("S6") + far);
    assert!(
        report.warnings()[0].contains("if it belongs to the surface"),
        "{:?}",
        report.warnings()
    );

    let below = "*NODE\n21, 0, 0, -9\n*ELEMENT, TYPE=C3D4\n9, 2, 3, 6,\n21\n10, 2, 6, 5, 21\n";
    let (_, report) = read("a.inp", second_order_plate("S6") + below);
    assert_eq!((report.skipped[0].count, report.warnings().len()), (2, 0));
}

/// A part library, without an assembly.
#[test]
fn parts_without_an_assembly_stand_where_they_are() {
    let part = PART.split("*Assembly").next().unwrap();
    assert_eq!(read("a.inp", part).1.triangles, 2);
}

/// The sheet-like mold of the shared data: an extruded profile with 3510 nodes and a reference point.
#[test]
fn the_blade_like_mold_is_one_open_surface() {
    let path = Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../../shared/data/molds/blade_like.inp"
    ));
    if !path.exists() {
        eprintln!("SKIPPED: {} is not there; the blade was not read", path.display());
        return;
    }
    let (mesh, report) = plydrape_io::read::mesh::read(path, 1.0, &Pose::ORIGIN, 0.0)
        .unwrap_or_else(|e| panic!("{e}"));
    // its sets say 1 to 3510 and 1 to 6764
    assert_eq!((report.vertices, report.triangles), (3510, 6764));
    assert_eq!((report.surfaces, report.closed, mesh.boundaries().len()), (1, 0, 1));
    assert!(mesh.triangles().len() == 6764 && report.holes.is_empty(), "{report}");
}

#[test]
fn a_mesh_is_scaled_and_then_placed() {
    let pose = Pose::new([1.0, 2.0, 3.0], [0.0, 0.0, std::f64::consts::FRAC_PI_2]);
    let text = "v 0 0 0\nv 1000 0 0\nv 0 500 0\nf 1 2 3\n";
    let (mesh, report) =
        plydrape_io::read::mesh::parse("a.obj", text.as_bytes(), 1e-3, &pose, 0.0).unwrap();
    let expected: [Point; 3] = [[0.5, 2.0, 3.0], [1.0, 2.0, 3.0], [1.0, 3.0, 3.0]];
    close(&sorted(&mesh), &expected, 1e-15);
    close(&report.bounds, &mesh.bounds(), 0.0);
}

/// One mesh with every kind of fault at once.
#[test]
fn repairs_are_reported_with_number_and_place() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1.0000001 1 0\nv 2 0 0\nv 2 1 0\n\
                f 1 2 3\nf 1 3 4\nf 1 3 4\nf 1 1 3\nf 1 2 2\nf 2 5 6\nf 6 7 5\nf 1 3 5\n";
    let (mesh, report) = read("a.obj", text);
    assert_eq!((report.triangles, report.vertices, report.surfaces), (4, 6, 1));
    assert_eq!((report.merged.count, report.merged.first[0].0), (1, 5));
    assert_eq!(report.duplicate.count, 1);
    assert_eq!(report.duplicate.first[0].0, 3);
    let numbers: Vec<u64> = report.degenerate.first.iter().map(|(number, _)| *number).collect();
    assert_eq!(numbers, [4, 5, 8]);
    // the sixth face runs along the edge from 2 to 3 as the first does
    assert_eq!((report.flipped.count, report.flipped.first[0].0), (1, 6));
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|n| mesh.vertices()[n as usize]);
        assert!((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0);
    }
    insta::assert_snapshot!("repairs", report);
}

/// A 3 × 3 grid without its middle cell, upside down.
#[test]
fn a_hole_is_told_from_the_outer_border() {
    let mut text = String::new();
    for n in 0..16 {
        text += &format!("v {} {} 0\n", n % 4, n / 4);
    }
    for n in (0..9).filter(|n| *n != 4) {
        let a = n / 3 * 4 + n % 3 + 1;
        text += &format!("f {} {} {} {}\n", a, a + 4, a + 5, a + 1);
    }
    let (mesh, report) = read("a.obj", text);
    assert_eq!((mesh.boundaries().len(), report.holes.len()), (2, 1));
    let hole = &report.holes[0];
    assert!((hole.length - 4.0).abs() < 1e-15);
    assert_eq!(hole.bounds, [[1.0, 1.0, 0.0], [2.0, 2.0, 0.0]]);
    assert_eq!(report.flipped.count, 16);
    let closest = mesh.closest_point([1.4, 1.5, 0.3]);
    assert!(closest.beyond && (closest.distance - 0.5).abs() < 1e-15, "{closest:?}");
    assert!(mesh.closest_point([0.5, 0.5, 0.1]).distance > 0.0);
    // the surface is to the left of each boundary: the outer one runs anticlockwise
    for boundary in mesh.boundaries() {
        let points: Vec<Point> =
            boundary.vertices.iter().map(|n| mesh.vertices()[*n as usize]).collect();
        let area: f64 = (0..points.len())
            .map(|n| (points[n], points[(n + 1) % points.len()]))
            .map(|(p, q)| 0.5 * (p[0] * q[1] - p[1] * q[0]))
            .sum();
        assert_eq!(area, if boundary.hole { -1.0 } else { 9.0 });
    }
    insta::assert_snapshot!("hole", report);
}

/// A solid whose triangles all face inwards, and one of two.
#[test]
fn closed_surfaces_face_outwards() {
    let inward = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
    let (mesh, report) = read("a.obj", inward);
    assert_eq!((report.closed, report.flipped.count), (1, 4));
    assert!(mesh.closest_point([0.1, 0.1, 0.1]).distance < 0.0);
    assert!(mesh.closest_point([-0.1, 0.1, 0.1]).distance > 0.0);

    let two = inward.to_owned()
        + "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";
    let (mesh, report) = read("a.obj", two);
    assert_eq!((report.surfaces, report.closed, report.flipped.count), (2, 2, 4));
    assert!(
        mesh.closest_point([0.1, 0.1, 0.1]).distance < 0.0
            && mesh.closest_point([5.1, 0.1, 0.1]).distance < 0.0
    );
}

/// Two squares that touch in one corner: their boundaries must not run into one another.
#[test]
fn surfaces_that_touch_in_a_vertex_only_are_parted() {
    let text =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 1 0\nv 2 2 0\nv 1 2 0\nf 1 2 3 4\nf 3 5 6 7\n";
    let (mesh, report) = read("a.obj", text);
    assert_eq!((report.surfaces, report.vertices, mesh.boundaries().len()), (2, 8, 2));
    assert!(mesh.boundaries().iter().all(|boundary| (boundary.length - 4.0).abs() < 1e-15));
    assert!(!mesh.closest_point([1.0, 1.0, 0.5]).beyond);
    assert!(mesh.closest_point([1.2, 0.8, 0.5]).beyond);
}

/// Files with something wrong, and what is said about them.
#[test]
fn broken_files_are_refused_with_place_and_remedy() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    let stl = ascii(&SQUARE);
    let cut = |text: &str, at: &str| text[..text.rfind(at).unwrap()].to_owned();
    let mut not_finite = binary(&SQUARE);
    not_finite[84 + 50 + 16..84 + 50 + 20].copy_from_slice(&f32::NAN.to_le_bytes());
    let truncated = binary(&SQUARE)[..150].to_vec();
    let mut announced = binary(&SQUARE);
    announced[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let moebius = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 .1\nv 2 1 .5\n\
                   f 1 2 5 4\nf 2 3 6 5\nf 3 4 1 6\n";
    let instance =
        |lines: &str| assembly(&format!("*Instance, name=S, part=Skin\n{lines}*End Instance\n"));
    let inp = |from: &str, to: &str| assembly("").replace(from, to);
    let cases: Vec<(&str, Vec<u8>)> = vec![
        ("no_format.step", b"ISO-10303-21;".to_vec()),
        ("no_extension", Vec::new()),
        ("empty.stl", Vec::new()),
        ("empty.obj", Vec::new()),
        ("empty.inp", Vec::new()),
        ("no_facets.stl", b"solid\nendsolid\n".to_vec()),
        ("no_triangles.stl", binary(&[])),
        ("truncated_binary.stl", truncated),
        ("too_many_announced.stl", announced),
        ("nan.stl", not_finite),
        ("short_rubbish.stl", b"\0\x01\x02".to_vec()),
        ("no_solid.stl", b"facet normal 0 0 1\n".to_vec()),
        ("truncated_text.stl", cut(&stl, "endloop").into()),
        ("no_endsolid.stl", cut(&stl, "endsolid").into()),
        ("four_vertices.stl", stl.replacen("endloop", "vertex 0 0 0", 1).into()),
        ("two_coordinates.stl", stl.replacen("vertex 0e0 0", "vertex 0e0", 1).into()),
        ("comma.stl", stl.replacen("0.25", "0,25", 1).into()),
        ("infinite.stl", stl.replacen("0.25", "inf", 1).into()),
        ("latin1.obj", b"# Oberfl\xe4che\nv 0 0 0\n".to_vec()),
        ("rubbish.obj", b"dear all\n".to_vec()),
        ("two_coordinates.obj", b"v 0 0\n".to_vec()),
        ("nan.obj", b"v 0 0 nan\n".to_vec()),
        ("index_too_large.obj", format!("{square}f 1 2 7\n").into()),
        ("index_too_far_back.obj", format!("{square}f 1 2 -5\n").into()),
        ("index_zero.obj", format!("{square}f 0 1 2\n").into()),
        ("index_huge.obj", format!("{square}f 1 2 -9223372036854775808\n").into()),
        ("two_corners.obj", format!("{square}f 1 2\n").into()),
        ("no_faces.obj", square.into()),
        ("freeform.obj", format!("{square}cstype bspline\n").into()),
        ("goes_on.obj", format!("{square}f 1 2 \\\n").into()),
        ("all_flat.obj", b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n".to_vec()),
        ("three_at_an_edge.obj", format!("{square}v 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 3 5\n").into()),
        ("moebius.obj", moebius.into()),
        ("upright.obj", b"v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n".to_vec()),
        ("millimeters_of_millimeters.obj", b"v 0 0 0\nv 1e-5 0 0\nv 0 1e-5 0\nf 1 2 3\n".to_vec()),
        ("huge.obj", b"v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n".to_vec()),
        ("element_without_node.inp", inp("7, 1, 2, 3, 4", "7, 1, 2, 3, 8").into()),
        ("short_element.inp", inp("7, 1, 2, 3, 4", "7, 1, 2, 3").into()),
        ("long_element.inp", inp("7, 1, 2, 3, 4", "7, 1, 2, 3, 4, 5").into()),
        ("cut_element.inp", inp("7, 1, 2, 3, 4", "7, 1, 2, 3,").into()),
        ("no_type.inp", inp("type=R3D4", "elset=E").into()),
        ("solid_elements.inp", inp("R3D4", "C3D4").into()),
        ("short_node.inp", inp("2, 1., 0., 0.", "2, 1., 0.").into()),
        ("bad_node.inp", inp("2, 1., 0., 0.", "2, 1., O., 0.").into()),
        ("node_twice.inp", inp("9, 5., 5., 5.", "2, 5., 5., 5.").into()),
        ("node_zero.inp", inp("9, 5., 5., 5.", "0, 5., 5., 5.").into()),
        ("cylindrical.inp", inp("*Node", "*Node, system=C").into()),
        ("node_file.inp", inp("*Node", "*Node, input=nodes.txt").into()),
        ("include.inp", inp("*Heading", "*Include, input=mesh.inp").into()),
        ("elgen.inp", inp("*Nset", "*Elgen").into()),
        ("unknown_part.inp", assembly("*Instance, name=S, part=Skim\n*End Instance\n").into()),
        ("bad_translation.inp", instance("1., 2.\n").into()),
        ("bad_rotation.inp", instance("0., 0., 0.\n0., 0., 0., 0., 0., 1.\n").into()),
        ("no_axis.inp", instance("0., 0., 0.\n0., 0., 1., 0., 0., 1., 90.\n").into()),
        ("third_line.inp", instance("0,0,0\n0,0,0,0,0,1,9\n1,2,3\n").into()),
        ("no_end_part.inp", cut(PART, "*End Part").into()),
        ("no_end_instance.inp", cut(&instance(""), "*End Instance").into()),
        ("part_in_part.inp", inp("*Nset", "*Part, name=B\n*Nset").into()),
    ];
    let mut messages = String::new();
    for (file, contents) in &cases {
        match parse(file, contents) {
            Ok((_, report)) => panic!("{file} passes: {report}"),
            Err(fault) => messages += &message(&fault),
        }
    }
    let missing =
        plydrape_io::read::mesh::read(Path::new("nowhere/mold.stl"), 1.0, &Pose::ORIGIN, 0.0);
    messages += &message(&missing.unwrap_err());
    for scale in [0.0, f64::NAN] {
        let fault =
            plydrape_io::read::mesh::parse("a.obj", square.as_bytes(), scale, &Pose::ORIGIN, 0.0)
                .unwrap_err();
        messages += &message(&fault);
    }
    insta::assert_snapshot!("messages", messages);
}

/// Cut off anywhere, or with any byte changed: a message or a mesh, never a panic.
#[test]
fn no_damage_to_a_file_makes_a_panic() {
    let files: [(&str, Vec<u8>); 4] = [
        ("a.stl", binary(&SQUARE)),
        ("a.stl", ascii(&SQUARE).into()),
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 -2 4\n".into()),
        (
            "a.inp",
            assembly("*Instance, name=S, part=Skin\n1,2,3\n0,0,0,0,0,1,90\n*End Instance\n").into(),
        ),
    ];
    for (file, bytes) in &files {
        for end in 0..bytes.len() {
            let _ = parse(file, &bytes[..end]);
            for byte in [0, b'\n', b'9', b'-', b'*', b',', 0xff] {
                let mut damaged = bytes.clone();
                damaged[end] = byte;
                let _ = parse(file, &damaged);
            }
        }
    }
}

/// Text of the file is quoted whole and never taken for the remedy.
#[test]
fn a_semicolon_in_a_file_is_part_of_the_fault() {
    let fault = parse("a.obj", "wall; floor\n").unwrap_err();
    assert!(fault.to_string().contains("`wall; floor`"), "{fault}");
    assert!(!fault.help().contains("floor"), "{}", fault.help());
}
