//! The plane of a face: its depth as an affine function of the place in the picture.
//!
//! It goes through the corners where they truly are, not where the grid has rounded them to. Faces of different corners
//! that lie in one plane have then the same depths, up to the last bits of double precision, and of these faces the same
//! one is nearest everywhere.

/// Depth at the grid's origin, and its growth per step of the grid.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    pub start: f64,
    pub dx: f64,
    pub dy: f64,
}

/// Steps of the grid: a triangle at most this high has no plane that rounding leaves as it is.
const LOW: f64 = 16.0;

impl Plane {
    pub const NONE: Plane = Plane { start: 0.0, dx: 0.0, dy: 0.0 };

    /// Through three corners: place and depth, steps of the grid. None for a triangle too low for that.
    #[inline(always)]
    pub fn through([a, b, c]: &[[f64; 3]; 3]) -> Option<Plane> {
        let (turn, longest) = (twice_area(a, b, c), square(a, b).max(square(b, c)).max(square(c, a)));
        // The height over the longest side is the least height.
        (turn * turn > longest * (LOW * LOW)).then(|| Plane::over(a, b, c, turn))
    }

    /// Through three corners of the grid that are not in line.
    #[inline(always)]
    pub fn on_grid(x: &[i32; 3], y: &[i32; 3], depth: &[f64; 3]) -> Plane {
        let [a, b, c] = [0, 1, 2].map(|k: usize| [f64::from(x[k]), f64::from(y[k]), depth[k]]);
        Plane::over(&a, &b, &c, twice_area(&a, &b, &c))
    }

    #[inline(always)]
    fn over(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3], turn: f64) -> Plane {
        let over = 1.0 / turn;
        let (z1, z2) = (b[2] - a[2], c[2] - a[2]);
        let dx = (z1 * (c[1] - a[1]) - z2 * (b[1] - a[1])) * over;
        let dy = (z2 * (b[0] - a[0]) - z1 * (c[0] - a[0])) * over;
        Plane { start: a[2] - dx * a[0] - dy * a[1], dx, dy }
    }
}

#[inline(always)]
fn twice_area(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

#[inline(always)]
fn square(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1])
}
