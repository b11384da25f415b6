//! A curve drawn with braille characters: two dots wide and four high each, so that both axes have
//! one scale on most terminals.

/// Dots of a picture at most, along and up: 60 by 12 characters.
const DOTS: [f64; 2] = [120.0, 48.0];
/// Height below which heights are drawn larger than they are, if that makes them visible (dots).
const LOW: f64 = 10.0;

/// Draws points [x, z] joined by lines, and says if heights are not to scale.
pub fn curve(points: &[[f64; 2]]) -> String {
    let range = |axis: usize| {
        let values = || points.iter().map(|point| point[axis]);
        let low = values().fold(f64::INFINITY, f64::min);
        (low, values().fold(f64::NEG_INFINITY, f64::max) - low)
    };
    let ((left, width), (bottom, height)) = (range(0), range(1));
    let mut scale = (DOTS[0] - 1.0) / width;
    if height * scale > DOTS[1] - 1.0 {
        scale = (DOTS[1] - 1.0) / height;
    }
    // a flat curve is drawn higher by a round factor, a straight one stays as it is
    let stretch = [2.0, 5.0, 10.0, 20.0, 50.0, 100.0]
        .into_iter()
        .rfind(|factor| height * scale * factor <= 2.0 * LOW)
        .filter(|_| height * scale < LOW && height * scale > 0.2)
        .unwrap_or(1.0);

    // dots from the top left
    let rows = (height * scale * stretch / 4.0) as usize + 1;
    let columns = (width * scale / 2.0) as usize + 1;
    let mut cells = vec![vec![0_u32; columns]; rows];
    let top = (4 * rows - 1) as f64;
    let mut put = |x: f64, z: f64| {
        let across = ((x - left) * scale).round() as usize;
        let up = (z - bottom) * scale * stretch;
        let down = (top - up).round().max(0.0) as usize;
        if let Some(cell) = cells.get_mut(down / 4).and_then(|row| row.get_mut(across / 2)) {
            *cell |= dot(across % 2, down % 4);
        }
    };
    for pair in points.windows(2) {
        let [[x0, z0], [x1, z1]] = [pair[0], pair[1]];
        let length = ((x1 - x0) * scale).abs() + ((z1 - z0) * scale * stretch).abs();
        let parts = 2.0 * length.ceil() + 1.0;
        for n in 0..=parts as usize {
            let t = n as f64 / parts;
            put(x0 + t * (x1 - x0), z0 + t * (z1 - z0));
        }
    }

    let mut text = String::new();
    for row in cells {
        let line: String =
            row.into_iter().filter_map(|cell| char::from_u32(0x2800 + cell)).collect();
        text.push_str("  ");
        text.push_str(line.trim_end_matches('\u{2800}'));
        text.push('\n');
    }
    if stretch > 1.0 {
        text.push_str(&format!("  heights drawn {stretch} times as large\n"));
    }
    text
}

/// The bit of a dot in its character: rows 0 to 2 count down each column, row 3 comes last.
fn dot(column: usize, row: usize) -> u32 {
    match (column, row) {
        (_, 3) => 0x40 << column,
        (0, row) => 1 << row,
        (_, row) => 8 << row,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of a square of 48 dots: by the Unicode chart, ⡀ is bottom left, ⠁ top left,
    /// ⢀ bottom right, ⠈ top right.
    #[test]
    fn a_picture_keeps_its_scale_and_its_corners() {
        let text = curve(&[[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
        let rows: Vec<&str> = text.lines().collect();
        assert_eq!(rows.len(), 12);
        assert_eq!(rows[0].trim().chars().count(), 24);
        assert!(rows[0].trim().starts_with('⡇'));
        assert!(rows[11].trim().starts_with('⣇'));
        assert!(rows[11].trim().ends_with('⣸'));
    }

    #[test]
    fn a_low_curve_says_that_it_is_drawn_higher() {
        let text = curve(&[[0.0, 0.0], [0.5, -0.01], [1.0, 0.0]]);
        assert!(text.contains("heights drawn 10 times as large"), "{text}");
        assert!(!curve(&[[0.0, 0.0], [1.0, 0.0]]).contains("heights"));
    }

    /// A span much higher than wide still has one column.
    #[test]
    fn a_steep_line_is_drawn() {
        assert_eq!(curve(&[[0.0, 0.0], [0.001, 1.0]]).lines().count(), 12);
    }
}
