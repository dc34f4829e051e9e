//! The one rounding of the visibility pass: view coordinates become integers on a power-of-two grid.
//!
//! |x|, |y| <= 2^30 - 1 keeps `orient2d` within 63 bits; |z| <= 2^29 leaves room to move a segment toward
//! the viewer by a contact tolerance of up to 2^28 units.

use super::Point;

const XY_LIMIT: f64 = ((1i64 << 30) - 1) as f64;
const Z_LIMIT: f64 = (1i64 << 29) as f64;
/// Largest contact tolerance in grid units.
pub const DELTA_LIMIT: f64 = (1i64 << 28) as f64;

/// Centre and scale of the grid: integer = round((coordinate - centre) * scale).
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    pub centre: [f64; 3],
    pub scale_xy: f64,
    pub scale_z: f64,
}

/// Largest power of two `s` with `half * s <= limit`, found without logarithms: libm differs between machines.
fn power_of_two_scale(half: f64, limit: f64) -> f64 {
    if half <= 0.0 {
        return 1.0;
    }
    let mut s = 1.0f64;
    while half * s > limit {
        s *= 0.5;
    }
    while half * s * 2.0 <= limit && s < 1e300 {
        s *= 2.0;
    }
    s
}

/// The nearest integer, ties to even, clamped to 32 bits. The result is that of `round_ties_even`, without a call:
/// between 2^52 and 2^53 doubles are whole numbers, so adding 1.5 * 2^52 rounds.
#[inline]
fn nearest(x: f64) -> i32 {
    const WHOLE: f64 = 6_755_399_441_055_744.0;
    ((x + WHOLE) - WHOLE) as i32
}

impl Grid {
    /// The finest grid that holds every point; None where a coordinate is not finite.
    pub fn around(points: &[[f64; 3]]) -> Option<Grid> {
        let (centre, half) = Grid::extent(points)?;
        Some(Grid {
            centre,
            scale_xy: power_of_two_scale(half[0].max(half[1]), XY_LIMIT),
            scale_z: power_of_two_scale(half[2], Z_LIMIT),
        })
    }

    /// The same with one step along all axes: the coarser of the two, of axes along which there is any extent.
    pub fn uniform_around(points: &[[f64; 3]]) -> Option<Grid> {
        let (centre, half) = Grid::extent(points)?;
        let (across, deep) = (half[0].max(half[1]), half[2]);
        let scales = [(across, XY_LIMIT), (deep, Z_LIMIT)].map(|(half, limit)| power_of_two_scale(half, limit));
        let scale = match scales {
            [xy, _] if deep <= 0.0 => xy,
            [_, z] if across <= 0.0 => z,
            [xy, z] => xy.min(z),
        };
        Some(Grid { centre, scale_xy: scale, scale_z: scale })
    }

    /// The middle of the points, and how far they reach from there; None where a coordinate is not finite.
    fn extent(points: &[[f64; 3]]) -> Option<([f64; 3], [f64; 3])> {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for p in points {
            for k in 0..3 {
                if !p[k].is_finite() {
                    return None;
                }
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        if points.is_empty() {
            (low, high) = ([0.0; 3], [0.0; 3]);
        }
        let mut centre = [0.0; 3];
        let mut half = [0.0; 3];
        for k in 0..3 {
            centre[k] = low[k] * 0.5 + high[k] * 0.5;
            half[k] = (high[k] - centre[k]).max(centre[k] - low[k]);
        }
        half.iter().all(|h| h.is_finite()).then_some((centre, half))
    }

    pub fn snap(&self, p: &[f64; 3]) -> Point {
        [
            nearest((p[0] - self.centre[0]) * self.scale_xy),
            nearest((p[1] - self.centre[1]) * self.scale_xy),
            nearest((p[2] - self.centre[2]) * self.scale_z),
        ]
    }

    /// Makes the grid so coarse in depth that a tolerance of `depth` fits. Where all depth is rounding noise, as for a
    /// plane seen face-on, the finest grid would turn that noise into steps larger than the tolerance.
    pub fn with_room(self, depth: f64) -> Grid {
        let mut scale_z = self.scale_z;
        while depth * scale_z > DELTA_LIMIT {
            scale_z *= 0.5;
        }
        Grid { scale_z, ..self }
    }

    pub fn unsnap(&self, p: &Point) -> [f64; 3] {
        [
            f64::from(p[0]) / self.scale_xy + self.centre[0],
            f64::from(p[1]) / self.scale_xy + self.centre[1],
            f64::from(p[2]) / self.scale_z + self.centre[2],
        ]
    }

    /// A depth tolerance in grid units: at least one unit where it is positive at all.
    pub fn delta(&self, depth: f64) -> i64 {
        if depth > 0.0 { (depth * self.scale_z).ceil().min(DELTA_LIMIT) as i64 } else { 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_integer_is_that_of_the_library() {
        let ties = [0.5, 1.5, 2.5, -0.5, -1.5, 1e9 + 0.5, 0.49999999999999994, -2.0, 1073741823.5, 2147483647.5];
        let far = [1e10, -1e10, 4.6e15, -9.1e15, 1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
        for x in ties.into_iter().chain(far) {
            assert_eq!(nearest(x), x.round_ties_even() as i32, "{x}");
        }
    }

    #[test]
    fn small_integers_are_kept_exactly() {
        let points: Vec<[f64; 3]> = vec![[0.0, 1.0, 2.0], [4.0, 3.0, 7.0], [1.0, 2.0, 3.0]];
        let grid = Grid::around(&points).unwrap();
        for p in &points {
            let s = grid.snap(p);
            for k in 0..3 {
                let scale = if k < 2 { grid.scale_xy } else { grid.scale_z };
                assert_eq!(f64::from(s[k]) / scale + grid.centre[k], p[k]);
            }
        }
    }

    #[test]
    fn a_uniform_grid_is_as_fine_where_all_points_lie_in_a_plane_or_a_line() {
        for (far, least) in [([1e-3, 2e-3, 0.0], 1 << 29), ([0.0, 0.0, 1e-3], 1 << 28), ([1e-3, 0.0, 1e-3], 1 << 28)] {
            let grid = Grid::uniform_around(&[[0.0; 3], far]).unwrap();
            assert_eq!(grid.scale_xy, grid.scale_z);
            let reach = grid.snap(&far);
            assert!((0..3).any(|k| reach[k] >= least) && reach.iter().all(|c| c.abs() < 1 << 30), "{far:?} {reach:?}");
        }
        assert_eq!(Grid::uniform_around(&[[5.0; 3]]).unwrap().snap(&[5.0; 3]), [0; 3]);
        assert!(Grid::uniform_around(&[[f64::NAN, 0.0, 0.0]]).is_none());
    }

    #[test]
    fn nan_and_infinity_are_refused() {
        assert!(Grid::around(&[[f64::NAN, 0.0, 0.0]]).is_none());
        assert!(Grid::around(&[[f64::INFINITY, 0.0, 0.0]]).is_none());
        assert!(Grid::around(&[[f64::MAX, 0.0, 0.0], [f64::MIN, 0.0, 0.0]]).is_some());
    }

    #[test]
    fn a_tolerance_finds_room() {
        let grid = Grid::around(&[[0.0, 0.0, 0.0], [1.0, 1.0, 1e-16]]).unwrap().with_room(1e-3);
        assert!(grid.delta(1e-3) > 1 && (grid.delta(1e-3) as f64) < DELTA_LIMIT);
        assert_eq!(grid.snap(&[1.0, 1.0, 1e-16])[2], 0);
    }

    #[test]
    fn a_tolerance_takes_no_more_room_than_it_needs() {
        for (deep, depth) in [(1e-16, 1e-3), (1.0, 1e-3), (1e3, 1e-2), (1e3, 1e4), (1e-6, 40.0)] {
            let grid = Grid::around(&[[0.0, 0.0, 0.0], [1.0, 1.0, deep]]).unwrap();
            let roomy = grid.with_room(depth);
            assert!(depth * roomy.scale_z <= DELTA_LIMIT, "{deep} {depth}");
            assert!(roomy.scale_z == grid.scale_z || 2.0 * depth * roomy.scale_z > DELTA_LIMIT, "{deep} {depth}");
        }
    }

    #[test]
    fn the_grid_is_as_fine_wherever_the_scene_lies() {
        for far in [0.0, 1e6, -1e6] {
            let (low, high) = ([far, far, far], [far + 2.0, far + 1.0, far + 0.5]);
            let grid = Grid::around(&[low, high]).unwrap();
            let (a, b) = (grid.snap(&low), grid.snap(&high));
            // With steps twice as fine the corners would lie off the grid.
            assert!(b[0] >= 1 << 29 && b[2] >= 1 << 28, "{far} {b:?}");
            assert!(a[0] <= -(1 << 29) && a[2] <= -(1 << 28), "{far} {a:?}");
        }
    }

    #[test]
    fn limits_hold_at_the_corners() {
        let grid = Grid::around(&[[-1e9, -1e-9, 5.0], [1e9, 1e-9, 5.0]]).unwrap();
        let s = grid.snap(&[1e9, 1e-9, 5.0]);
        assert!(s[0] <= XY_LIMIT as i32 && s[0] > (1 << 29));
        assert_eq!(s[2], 0);
    }
}
