//! The height of a mold z = f(x, y) with its derivatives.

/// Height of a surface at a place (x, y), with first and second derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Height {
    /// Height z = f(x, y) (m).
    pub z: f64,
    /// Slopes ∂f/∂x and ∂f/∂y.
    pub gradient: [f64; 2],
    /// ∂²f/∂x², ∂²f/∂x∂y and ∂²f/∂y² (1/m).
    pub hessian: [f64; 3],
}
