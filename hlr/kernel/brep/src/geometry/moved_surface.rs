//! Transforms the record of a surface by a placement: rotation, mirror image and translation.

use super::curve::Curve;

type Matrix = [[f64; 4]; 3];

/// Largest departure of the determinant from 1 that counts as rounding.
const LENGTHENS: f64 = 1e-9;

/// The numbers of a record, as `Surface::read` takes them, moved by a (3, 4) matrix. None if they make no surface, or
/// if the matrix changes lengths, since some parameters are lengths.
pub fn moved(kind: u8, data: &[f64], m: &Matrix) -> Option<Vec<f64>> {
    let apply = |v: &[f64], w: f64| m.map(|r| r[0] * v[0] + r[1] * v[1] + r[2] * v[2] + r[3] * w);
    let determinant = (0..3)
        .map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            m[0][k] * (m[1][i] * m[2][j] - m[1][j] * m[2][i])
        })
        .sum::<f64>();
    if (determinant.abs() - 1.0).abs() > LENGTHENS {
        return None;
    }
    let mut out = Vec::with_capacity(data.len());
    match kind {
        1..=5 => {
            let (frame, sizes) = data.split_at_checked(12)?;
            out.extend(apply(&frame[..3], 1.0));
            for k in [3, 6, 9] {
                out.extend(apply(&frame[k..k + 3], 0.0));
            }
            out.extend(sizes);
        }
        6 | 7 => {
            let head = if kind == 6 { 6 } else { 3 };
            let (axis, rest) = data.split_at_checked(head)?;
            let (number, curve) = rest.split_first()?;
            if kind == 6 {
                out.extend(apply(&axis[..3], 1.0));
                // A mirror image reverses the sense of rotation.
                out.extend(apply(&axis[3..], 0.0).map(|c| c * determinant.signum()));
            } else {
                out.extend(apply(axis, 0.0));
            }
            let at = out.len();
            out.push(0.0);
            let kind = Curve::from_record(*number as u8, curve)?.moved(m).record(&mut out);
            out[at] = f64::from(kind);
        }
        8 => {
            let counts = [*data.get(2)? as usize, *data.get(3)? as usize];
            let begin = data.len().checked_sub(4 * counts[0].checked_mul(counts[1])?)?;
            out.extend(&data[..begin]);
            for pole in data[begin..].as_chunks::<4>().0 {
                out.extend(apply(pole, 1.0));
                out.push(pole[3]);
            }
        }
        9 => {
            let (head, basis) = data.split_at_checked(2)?;
            out.extend([head[0] * determinant.signum(), head[1]]);
            out.extend(moved(head[1] as u8, basis, m)?);
        }
        _ => return None,
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::surface::Surface;

    /// A mirror image with a rotation.
    const MOVE: Matrix = [[0.0, 1.0, 0.0, 1.0], [1.0, 0.0, 0.0, -3.0], [0.0, 0.0, 1.0, 0.5]];

    #[test]
    fn a_moved_surface_is_the_surface_of_moved_points() {
        let frame = [0.1, 0.2, 0.3, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let line = [1.0, 2.0, 0.0, 0.5, 0.0, 0.3, 1.0, 0.0, 0.0, 0.0];
        let with = |more: &[f64]| [&frame[..], more].concat();
        let patch = [1.0, 1.0, 2.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0]
            .iter()
            .chain(&[0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.2, 1.0, 0.0, 1.0, 0.3, 1.0, 1.0, 1.0, 0.0, 2.0])
            .copied()
            .collect::<Vec<_>>();
        for (kind, data) in [
            (1, with(&[])),
            (2, with(&[1.5])),
            (3, with(&[1.5, 0.3])),
            (4, with(&[1.5])),
            (5, with(&[3.0, 0.5])),
            (6, [&[0.0, 0.0, 0.0, 0.0, 0.0, 1.0][..], &line].concat()),
            (7, [&[0.0, 1.0, 0.5][..], &line].concat()),
            (8, patch.clone()),
            (9, [&[0.25, 8.0][..], &patch].concat()),
        ] {
            let before = Surface::read(kind, &data).unwrap();
            let after = Surface::read(kind, &moved(kind, &data, &MOVE).unwrap()).unwrap();
            for uv in [[0.3, 0.2], [0.9, 0.7]] {
                let p = before.point(uv);
                let wanted = MOVE.map(|r| r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3]);
                let found = after.point(uv);
                assert!((0..3).all(|k| (wanted[k] - found[k]).abs() < 1e-12), "{kind}: {wanted:?} {found:?}");
            }
        }
    }
}
