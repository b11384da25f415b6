//! Surface elements of Abaqus by name: how many nodes they have and how many of these are corners.

/// Families of surface elements: how their names begin, their nodes and their corners.
///
/// What follows in a name says how the element is integrated or what else it computes: S4R, S8R5, M3D4R.
const FAMILIES: [(&str, usize, usize); 19] = [
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
    ("S9R5", 9, 4),
    ("S8R", 8, 4),
];

/// Nodes and corners of an element type (capital letters); none if it is no surface.
pub(super) fn surface(kind: &str) -> Option<(usize, usize)> {
    let found = FAMILIES.iter().find(|(name, ..)| kind.starts_with(name));
    match found {
        Some(&(_, nodes, corners)) => Some((nodes, corners)),
        // conventional shells: S3, S3R, S4, S4RSW, …; not SC6R, SAX1 or SPRINGA
        None => match kind.as_bytes() {
            [b'S', b'3', rest @ ..] if rest.first() != Some(&b'D') => Some((3, 3)),
            [b'S', b'4', ..] => Some((4, 4)),
            _ => None,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::surface;

    /// Names as in the element index of Abaqus.
    #[test]
    fn surface_elements_are_known_by_name_and_others_are_not() {
        for kind in ["S3", "S3R", "S3RS", "STRI3", "DS3", "M3D3", "SFM3D3", "R3D3", "S3T"] {
            assert_eq!(surface(kind), Some((3, 3)), "{kind}");
        }
        for kind in ["S4", "S4R", "S4RS", "S4RSW", "S4R5", "R3D4", "M3D4R", "SFM3D4R", "DS4"] {
            assert_eq!(surface(kind), Some((4, 4)), "{kind}");
        }
        assert_eq!(surface("STRI65"), Some((6, 3)));
        assert_eq!(surface("S8R5"), Some((8, 4)));
        for kind in ["C3D8R", "SC8R", "MASS", "SPRINGA", "B31", "T3D2", "SAX1", "CPS4", "C3D4"] {
            assert_eq!(surface(kind), None, "{kind}");
        }
    }
}
