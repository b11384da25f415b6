//! The drape of the same motion by another program, beside that of the sheet.

use crate::peer::{Compared, Comparison, NAME, Pair, cost, ends, percent};
use serde::Serialize;

/// What the page shows of it.
#[derive(Serialize)]
pub(super) struct Peer {
    name: &'static str,
    /// Of the end and of the first touch: words, the sheet's value, the other program's.
    ends: Vec<[String; 3]>,
    /// What the other drape took, in a sentence.
    cost: String,
    courses: Vec<PeerCourse>,
    farthest: Option<Farthest>,
}

/// Two values over the steps of the page; `None` in steps whose states were not kept.
#[derive(Serialize)]
struct PeerCourse {
    key: &'static str,
    label: &'static str,
    unit: &'static str,
    first: Vec<Option<f64>>,
    /// What the second one is called.
    name: &'static str,
    second: Vec<Option<f64>>,
}

/// Where the same fabric point is farthest apart.
#[derive(Serialize)]
struct Farthest {
    step: usize,
    node: usize,
    uv_mm: [f64; 2],
    apart_mm: f64,
}

impl Peer {
    /// A comparison over these steps.
    pub fn new(comparison: &Comparison, steps: &[usize]) -> Self {
        // of a step with several states the last one
        let kept: Vec<Option<&Compared>> = steps
            .iter()
            .map(|step| comparison.steps.iter().rfind(|compared| compared.step == *step))
            .collect();
        let course = |key, label, unit, name, pair: fn(&Compared) -> Pair| {
            let pairs = || kept.iter().map(|compared| compared.map(pair));
            PeerCourse {
                key,
                label,
                unit,
                first: pairs().map(|pair| pair?.plydrape).collect(),
                name,
                second: pairs().map(|pair| pair?.peer).collect(),
            }
        };
        let apart: fn(&Compared) -> Pair = |compared| Pair {
            plydrape: Some(compared.apart_rms_mm),
            peer: Some(compared.apart_max_mm),
        };
        let farthest =
            kept.iter().flatten().max_by(|a, b| a.apart_max_mm.total_cmp(&b.apart_max_mm));
        Peer {
            name: NAME,
            ends: ends(comparison),
            cost: cost(comparison),
            courses: vec![
                course("lowest", "lowest point", "mm", NAME, |compared| compared.lowest_mm),
                course("lies", "share that lies", "%", NAME, |compared| percent(compared.lies)),
                course("shear", "largest shear", "°", NAME, |compared| compared.shear_deg),
                course("load", "largest load of a cup", "N", NAME, |compared| compared.load_n),
                course("apart", "points apart, mean", "mm", "at most", apart),
            ],
            farthest: farthest.map(|compared| Farthest {
                step: compared.step,
                node: compared.apart_node,
                uv_mm: compared.apart_uv_mm,
                apart_mm: compared.apart_max_mm,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compared(step: usize, apart: f64) -> Compared {
        let pair = |plydrape, peer| Pair { plydrape: Some(plydrape), peer: Some(peer) };
        Compared {
            step,
            time: 0.0,
            lowest_mm: pair(apart, 2.0 * apart),
            lies: pair(0.25, 0.5),
            shear_deg: pair(1.0, 2.0),
            load_n: pair(3.0, 4.0),
            apart_rms_mm: 0.5 * apart,
            apart_max_mm: apart,
            apart_uv_mm: [10.0, 20.0],
            apart_node: 7 * step,
        }
    }

    /// Courses have the last state of each step that was kept and nothing in the others; the largest distance is that of the steps in view.
    #[test]
    fn courses_are_of_the_steps_that_were_kept() {
        let none = Pair { plydrape: None, peer: None };
        let comparison = Comparison {
            height_max_mm: Pair { plydrape: Some(0.5), peer: Some(1.25) },
            height_rms_mm: none,
            height_share: none,
            first_touch: [None, None],
            steps: vec![compared(1, 9.0), compared(1, 1.0), compared(3, 4.0), compared(4, 2.0)],
            cpu_s: 5.0,
            time_steps: 6,
            solves: 7,
            refused: 8,
        };
        let shown = Peer::new(&comparison, &[1, 2, 3, 4]);
        let course = |key| shown.courses.iter().find(|course| course.key == key).unwrap();
        assert_eq!(course("lowest").first, [Some(1.0), None, Some(4.0), Some(2.0)]);
        assert_eq!(course("lowest").second, [Some(2.0), None, Some(8.0), Some(4.0)]);
        assert_eq!(course("lies").second, [Some(50.0), None, Some(50.0), Some(50.0)]);
        assert_eq!(course("apart").first, [Some(0.5), None, Some(2.0), Some(1.0)]);
        let farthest = shown.farthest.unwrap();
        assert_eq!((farthest.step, farthest.node, farthest.apart_mm), (3, 21, 4.0));
        assert_eq!(shown.ends[0][1..], ["0.50", "1.25"]);
        assert!(shown.cost.contains("7 linear systems"), "{}", shown.cost);
    }
}
