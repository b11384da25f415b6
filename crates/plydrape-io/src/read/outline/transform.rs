//! Where blocks are placed: maps of the plane that keep lines straight.

/// The map `x p[0] + y p[1] + origin` of a point p.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transform {
    /// Image of (1, 0), from the origin.
    pub x: [f64; 2],
    /// Image of (0, 1), from the origin.
    pub y: [f64; 2],
    /// Image of (0, 0).
    pub origin: [f64; 2],
}

impl Transform {
    /// A scale about the origin.
    pub fn scale(by: f64) -> Self {
        Transform { x: [by, 0.0], y: [0.0, by], origin: [0.0; 2] }
    }

    /// A shift.
    pub fn shift(origin: [f64; 2]) -> Self {
        Transform { origin, ..Transform::scale(1.0) }
    }

    /// A counterclockwise turn about the origin (rad).
    pub fn turn(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Transform { x: [cos, sin], y: [-sin, cos], origin: [0.0; 2] }
    }

    /// A drawing seen from behind: DXF turns it about its y axis.
    pub fn mirror() -> Self {
        Transform { x: [-1.0, 0.0], ..Transform::scale(1.0) }
    }

    /// The image of a point.
    pub fn apply(&self, p: [f64; 2]) -> [f64; 2] {
        let along = self.along(p);
        [along[0] + self.origin[0], along[1] + self.origin[1]]
    }

    /// This map after another one.
    #[must_use]
    pub fn after(&self, first: &Transform) -> Self {
        Transform {
            x: self.along(first.x),
            y: self.along(first.y),
            origin: self.apply(first.origin),
        }
    }

    /// The image of a direction.
    fn along(&self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|n| self.x[n] * p[0] + self.y[n] * p[1])
    }
}
