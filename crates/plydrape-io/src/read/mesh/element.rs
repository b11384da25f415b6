//! Elements of Abaqus and CalculiX by name: which are faces, with how many nodes and corners, and which are none.

/// Families of faces: how their names begin, their nodes and their corners. The corners come first.
///
/// What follows in a name says how the element is integrated or what else it computes: S4R, S8R5, M3D4R, CPS4RT.
/// CalculiX has S6 and S8. Gmsh writes the faces of any surface as CPS3, CPS4, CPS6 and CPS8.
const FACES: [(&str, usize, usize); 38] = [
    ("STRI65", 6, 3),
    ("STRI3", 3, 3),
    ("SFM3D3", 3, 3),
    ("SFM3D4", 4, 4),
    ("SFM3D6", 6, 3),
    ("SFM3D8", 8, 4),
    ("M3D3", 3, 3),
    ("M3D4", 4, 4),
    ("M3D6", 6, 3),
    ("M3D8", 8, 4),
    ("M3D9", 9, 4),
    ("R3D3", 3, 3),
    ("R3D4", 4, 4),
    ("DS3", 3, 3),
    ("DS4", 4, 4),
    ("DS6", 6, 3),
    ("DS8", 8, 4),
    ("DC2D3", 3, 3),
    ("DC2D4", 4, 4),
    ("DC2D6", 6, 3),
    ("DC2D8", 8, 4),
    ("CPS3", 3, 3),
    ("CPS4", 4, 4),
    ("CPS6", 6, 3),
    ("CPS8", 8, 4),
    ("CPE3", 3, 3),
    ("CPE4", 4, 4),
    ("CPE6", 6, 3),
    ("CPE8", 8, 4),
    ("CPEG3", 3, 3),
    ("CPEG4", 4, 4),
    ("CPEG6", 6, 3),
    ("CPEG8", 8, 4),
    ("S3", 3, 3),
    ("S4", 4, 4),
    ("S6", 6, 3),
    ("S8", 8, 4),
    ("S9", 9, 4),
];

/// How the names of elements begin that are no faces: solids, lines, points, sections of bodies of revolution, and what
/// connects others.
const NO_FACES: [&str; 44] = [
    "AC", "B21", "B22", "B23", "B31", "B32", "B33", "C3D", "CAX", "CCL", "CGAX", "CIN", "COH",
    "CONN", "DASHPOT", "DC1D", "DC3D", "DCAX", "DCC", "DCOUP", "DRAG", "ELBOW", "EMC", "F2D",
    "F3D", "FAX", "FRAME", "GAP", "GK", "HEATCAP", "ITS", "JOINT", "MASS", "MAX", "MGAX", "PIPE",
    "R2D", "RAX", "RB", "ROTARYI", "SAX", "SPRING", "T2D", "T3D",
];

/// What a type of element is to a mold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Element {
    /// A face.
    Face {
        /// How many nodes it has.
        nodes: usize,
        /// How many of them, the first ones, are its corners.
        corners: usize,
    },
    /// A shell with a thickness of its own and so with two faces, of which nobody says which one the ply touches.
    Thick,
    /// No face.
    NoFace,
    /// Nothing is known of it.
    Unknown,
}

/// What an element type (capital letters) is.
pub(super) fn element(kind: &str) -> Element {
    if let Some(&(_, nodes, corners)) = FACES.iter().find(|(name, ..)| kind.starts_with(name)) {
        return Element::Face { nodes, corners };
    }
    if ["SC6", "SC8", "CSS8"].iter().any(|name| kind.starts_with(name)) {
        return Element::Thick;
    }
    match NO_FACES.iter().any(|name| kind.starts_with(name)) {
        true => Element::NoFace,
        false => Element::Unknown,
    }
}

#[cfg(test)]
mod tests {
    use super::{Element, element};

    /// Names as in the element indices of Abaqus and CalculiX, and as Gmsh writes them.
    #[test]
    fn faces_are_known_by_name_with_their_corners_and_others_are_not() {
        let faces = [
            (3, 3, "S3 S3R S3RS S3T S3RT STRI3 DS3 M3D3 SFM3D3 R3D3 CPS3 CPE3 DC2D3"),
            (4, 4, "S4 S4R S4RS S4RSW S4R5 S4T R3D4 M3D4 M3D4R SFM3D4R DS4 CPS4 CPS4R CPE4I DC2D4"),
            (6, 3, "S6 STRI65 M3D6 SFM3D6 DS6 CPS6 CPS6M CPE6 DC2D6"),
            (8, 4, "S8 S8R S8R5 S8RT M3D8 M3D8R SFM3D8R DS8 CPS8 CPS8R CPE8RT DC2D8"),
            (9, 4, "S9R5 M3D9 M3D9R"),
        ];
        for (nodes, corners, kinds) in faces {
            for kind in kinds.split(' ') {
                assert_eq!(element(kind), Element::Face { nodes, corners }, "{kind}");
            }
        }
        for kind in ["SC6R", "SC8R", "SC8RT", "CSS8"] {
            assert_eq!(element(kind), Element::Thick, "{kind}");
        }
        let others = "C3D8R C3D4 C3D20R MASS SPRINGA B31 B32OS T3D2 T2D3 SAX1 CAX4 CAX8R COH3D8 CONN3D2 DC3D4 GAPUNI F3D4";
        for kind in others.split(' ') {
            assert_eq!(element(kind), Element::NoFace, "{kind}");
        }
        for kind in ["U1", "SHELL93", "QUAD4", "VU22"] {
            assert_eq!(element(kind), Element::Unknown, "{kind}");
        }
    }
}
