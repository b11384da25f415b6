//! A look at a scene before anything is draped on its mold: where the ply must end, which way its warp runs there and on the
//! table, where the cups shall end, and which cups of the array do not hold.

use crate::scene::SceneFile;
use plydrape::geometry::vector::{along, sub};
use plydrape::layup::Layup;
use plydrape::ply::{Direction, Ply};
use serde::Serialize;

/// Length of the arrow along the warp, as a share of the ply's longer side.
const ARROW: f64 = 0.25;
/// Points along the shaft of an arrow.
const SHAFT: usize = 16;
/// Length and half the width of its head, as shares of the arrow.
const HEAD: [f64; 2] = [0.25, 0.1];

/// What the lines of the picture are.
pub(super) const LEGEND: [(&str, &str); 2] = [
    (
        "drawn",
        "upright crosses: where the cups shall end; the line around them: where the ply must end",
    ),
    (
        "",
        "arrows: the warp, from the middle of the ply; leaning crosses: cups of the array that do not hold",
    ),
];

/// A warning as a sentence.
pub(super) fn sentence(warning: &str) -> String {
    let mut letters = warning.chars();
    let first = letters.next().map(char::to_uppercase).into_iter().flatten();
    first.chain(letters).chain(['.']).collect()
}

/// What is drawn beside ply, grippers, cell and mold.
#[derive(Debug, Serialize)]
pub(super) struct Look {
    /// The boundary of the ply and of its holes where they must end on the mold, each a line (m).
    outline: Vec<Vec<[f64; 3]>>,
    /// Arrows along the warp from the middle of the ply, on the table and on the mold: a shaft and a head (m).
    warp: Vec<Vec<[f64; 3]>>,
    /// Where the cups shall end (m).
    targets: Vec<[f64; 3]>,
    /// Cups of the array that do not hold the ply, at the start (m).
    off: Vec<[f64; 3]>,
}

/// The look at a scene.
pub(super) fn look(scene: &SceneFile) -> Look {
    let Layup { ply, mold, target, .. } = &scene.layup;
    let start = scene.layup.start();
    let net = target.as_ref().and_then(|target| target.drape.as_deref());
    let on_table = FlatPly::through(ply, start);
    let on_mold = net.zip(mold.as_ref());
    let place = |uv| on_mold.and_then(|(net, mold)| net.place_or_node(mold, uv));
    let outline = on_mold.and_then(|(net, mold)| net.boundary(mold)).map(|boundary| {
        let line = |line: &plydrape::net::BoundaryLine| {
            let points = line.points.iter().map(|point| point.place);
            let again = line.points.first().filter(|_| line.closed).map(|point| point.place);
            points.chain(again).collect()
        };
        boundary.lines.iter().map(line).collect()
    });
    let arrows =
        [arrow(ply, |uv| on_table.as_ref().map(|table| table.place(uv))), arrow(ply, place)];
    Look {
        outline: outline.unwrap_or_default(),
        warp: arrows.into_iter().flatten().collect(),
        targets: target.as_ref().map_or_else(Vec::new, |target| target.grippers.clone()),
        off: left_off(scene, on_table.as_ref()),
    }
}

/// Shaft and head of an arrow along the warp, where a map has places for them.
fn arrow(ply: &Ply, place: impl Fn([f64; 2]) -> Option<[f64; 3]>) -> Vec<Vec<[f64; 3]>> {
    let [low, high] = ply.bounds(0.0);
    let length = ARROW * (high[0] - low[0]).max(high[1] - low[1]);
    let middle = ply.middle();
    // so far along the warp and across it, as shares of the arrow
    let point = |ahead: f64, aside: f64| {
        let [a, b] = [ahead * length, aside * length];
        let [u, v] = match ply.warp {
            Direction::U => [a, b],
            Direction::V => [-b, a],
        };
        place([middle[0] + u, middle[1] + v])
    };
    let shaft = (0..=SHAFT).map_while(|n| point(n as f64 / SHAFT as f64, 0.0)).collect();
    let [long, wide] = HEAD;
    let head = [point(1.0 - long, wide), point(1.0, 0.0), point(1.0 - long, -wide)];
    [Some(shaft), head.into_iter().collect()].into_iter().flatten().collect()
}

/// Places (m) of the cups that do not hold.
fn left_off(scene: &SceneFile, on_table: Option<&FlatPly>) -> Vec<[f64; 3]> {
    let (Some(cups), Some(table), Some(cut)) = (&scene.cups, on_table, &scene.layup.ply.cut) else {
        return Vec::new();
    };
    cups.left_off.iter().map(|cup| table.place(cut.fabric(cup.drawn))).collect()
}

/// The flat ply among its grippers: the map from fabric coordinates that is nearest to their places.
struct FlatPly {
    /// Middle of the grippers in fabric coordinates (m).
    middle: [f64; 2],
    /// Middle of the places of the grippers (m).
    origin: [f64; 3],
    /// What a place moves by along u and along v.
    along: [[f64; 3]; 2],
}

impl FlatPly {
    /// Through the grippers of a ply at places (m); `None` for grippers in one line.
    fn through(ply: &Ply, places: &[[f64; 3]]) -> Option<Self> {
        let count = places.len() as f64;
        let fabric: Vec<[f64; 2]> = (0..places.len()).map(|n| ply.place(n)).collect();
        let middle = [0, 1].map(|n| fabric.iter().map(|uv| uv[n]).sum::<f64>() / count);
        let origin = [0, 1, 2].map(|n| places.iter().map(|p| p[n]).sum::<f64>() / count);

        // least squares of two unknown directions
        let (mut squares, mut products) = ([[0.0; 2]; 2], [[0.0; 3]; 2]);
        for (uv, place) in fabric.iter().zip(places) {
            let (off, way) = ([0, 1].map(|n| uv[n] - middle[n]), sub(*place, origin));
            for n in 0..2 {
                for m in 0..2 {
                    squares[n][m] += off[n] * off[m];
                }
                products[n] = along(products[n], off[n], way);
            }
        }
        let [[a, b], [_, d]] = squares;
        let determinant = a * d - b * b;
        let has_area = determinant > 1e-9 * (a + d) * (a + d);
        if !has_area {
            return None;
        }
        let [p, q] = products;
        let solved = |s: f64, t: f64| [0, 1, 2].map(|n| (s * p[n] + t * q[n]) / determinant);
        Some(FlatPly { middle, origin, along: [solved(d, -b), solved(-b, a)] })
    }

    fn place(&self, uv: [f64; 2]) -> [f64; 3] {
        let [u, v] = [0, 1].map(|n| uv[n] - self.middle[n]);
        along(along(self.origin, u, self.along[0]), v, self.along[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene;
    use plydrape::geometry::vector::distance;
    use std::path::Path;

    /// A ply whose warp runs at 30° in its drawing, and heads at 100° on a plane and at −20° on the table.
    const SCENE: &str = "[ply]\nsize = [0.36, 0.26]\nwarp = \"30 deg\"\ngrippers = [4, 3]\ncell = [0.1, 0.1]\n\
        array = { margin = 0.01, holds = [\"####\", \"###.\", \"####\"] }\nmaterial = \"krogh2018\"\n\
        [mold]\nkind = \"plane\"\n[grippers]\npad_radius = 0.015\nspacing = [0.098, 0.098]\nheight = 0.05\n\
        middle = [1.0, 0.5]\ndirection = \"-20 deg\"\n[target]\norigin = [0.2, 0.1]\ndirection = \"100 deg\"\n";

    /// Both arrows begin in the middle of the drawing and head as the scene says; the outline on the mold is as long as that of the
    /// drawing; the cup that does not hold is where the array has it.
    #[test]
    fn arrows_outline_and_cups_are_where_the_scene_has_them() {
        let scene = scene::parse(SCENE, Path::new(""), "scene").unwrap();
        let look = look(&scene);
        let [table, table_head, mold, mold_head] = &look.warp[..] else { panic!("two arrows") };
        for (shaft, head, from, heading) in [
            (table, table_head, [1.0, 0.5, 0.05], -20_f64),
            (mold, mold_head, [0.2, 0.1, 0.0], 100.0),
        ] {
            let (first, last) = (shaft[0], shaft[SHAFT]);
            assert!(distance(first, from) < 1e-9 && distance(last, head[1]) < 1e-9, "{first:?}");
            let arrow = sub(last, first);
            assert!((arrow[1].atan2(arrow[0]) - heading.to_radians()).abs() < 1e-9, "{arrow:?}");
        }
        let length = |line: &Vec<[f64; 3]>| -> f64 {
            line.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
        };
        let around: f64 = look.outline.iter().map(length).sum();
        assert!((around - 2.0 * (0.36 + 0.26)).abs() < 1e-9, "{around}");
        assert_eq!((look.targets.len(), look.off.len()), (11, 1));
        // the drawing's x axis heads 50° to the right of the warp on the table; this cup is 150 mm along it from the middle
        let (sin, cos) = (-50_f64).to_radians().sin_cos();
        let expected = [1.0 + 0.147 * cos, 0.5 + 0.147 * sin, 0.05];
        assert!(distance(look.off[0], expected) < 1e-9, "{:?} {expected:?}", look.off[0]);
    }
}
