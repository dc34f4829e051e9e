//! Chords of a border that are much longer than the edges of the mesh beside them.
//!
//! A straight edge is one chord, however long it is. Where the surface beside it is wavy, as a plate through given
//! points is, the triangle on this chord has sides as long, which leave the surface wherever their third corner is:
//!
//! ```text
//!      .   .   .   .   .   .
//!    .   .   .  . x .   .   .      x: points nearer to the chord make its triangle thinner, not flatter
//!      .  _ . --   -- . _   .
//!    o-----------------------o
//! ```

use super::face::FaceLoops;
use super::outline::Outline;
use super::progress::Progress;
use super::spacing::Field;
use crate::geometry::surface::Surface;
use hlr_exact::elementary::hypot;

/// Largest length of a chord, in spacings of the mesh.
const LONGEST: f64 = 16.0;
/// Places on a chord at which the spacing is asked for.
const PLACES: u32 = 8;

/// Chords longer than that, each as loop and number within the loop.
pub fn long_chords(
    surface: &Surface,
    loops: &FaceLoops,
    deflection: f64,
    angle: f64,
    steps: &Progress,
) -> Vec<[usize; 2]> {
    let Ok(outline) = Outline::new(loops, |_, _, _| ()) else { return Vec::new() };
    let bounds = outline.bounds();
    if !(0..2).all(|k| bounds[0][k] < bounds[1][k]) {
        return Vec::new();
    }
    let Some(field) = Field::new(surface, bounds, deflection, angle, true, steps) else { return Vec::new() };
    let long = |&c: &u32| {
        let [a, b] = [c, outline.after(c)].map(|i| field.to_chart(outline.uv[i as usize]));
        let piece = hypot(b[0] - a[0], b[1] - a[1]) / f64::from(PLACES);
        let spacings = (0..PLACES).map(|i| {
            let share = (f64::from(i) + 0.5) / f64::from(PLACES);
            piece / field.at([0, 1].map(|k| a[k] + share * (b[k] - a[k])))
        });
        spacings.sum::<f64>() > LONGEST
    };
    let named = |c: u32| outline.origin.get(c as usize).map(|&(number, chord)| [number, chord]);
    outline.chords().filter(long).filter_map(named).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::tests::shapes::{frame, loops};

    /// Waves along x between straight borders y = 0 and y = 1: cubic along x with so many poles, quadratic along y.
    fn waves(poles: u32, height: f64) -> Surface {
        let spans = poles - 3;
        let mut record = vec![3.0, 2.0, f64::from(poles), 3.0, 0.0, 0.0];
        let ends = [0, spans].map(|knot| [f64::from(knot); 4]);
        let knots: Vec<f64> = (1..spans).map(f64::from).collect();
        record.extend(ends[0].iter().chain(&knots).chain(&ends[1]));
        record.extend([0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
        let at = |i: u32| record[7 + i as usize..10 + i as usize].iter().sum::<f64>() / 3.0;
        let places: Vec<f64> = (0..poles).map(at).collect();
        for (i, x) in places.into_iter().enumerate() {
            let wave = if i % 2 == 0 { height } else { -height };
            for (y, z) in [(0.0, 0.0), (0.5, wave), (1.0, 0.0)] {
                record.extend([x, y, z, 1.0]);
            }
        }
        Surface::read(8, &record).expect("a surface")
    }

    fn found(surface: &Surface, length: f64, steps: usize) -> Vec<usize> {
        let face = loops(surface, &[frame([0.0, 0.0], [length, 1.0], steps, 1)]);
        long_chords(surface, &face, 0.01, 0.5, &Progress::free()).into_iter().map(|[_, chord]| chord).collect()
    }

    #[test]
    fn straight_borders_beside_waves_are_long_until_they_are_divided() {
        let wavy = waves(23, 0.4);
        let (border, crest) = (wavy.point([10.0, 0.0]), wavy.point([10.0, 0.5]));
        assert!((border[0] - 10.0).abs() < 1e-12 && border[2] == 0.0 && crest[2].abs() > 0.05, "{border:?} {crest:?}");
        let whole = found(&wavy, 20.0, 1);
        assert_eq!(whole, [0, 2], "not the short sides");
        assert!(!found(&wavy, 20.0, 2).is_empty());
        assert!(found(&wavy, 20.0, 32).is_empty());
        // Nothing is long where the surface is flat.
        assert!(found(&waves(23, 0.0), 20.0, 1).is_empty());
    }
}
