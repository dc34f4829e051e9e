//! Reads the sections of curves, in (u, v) and in space.

use super::tokens::{Read, Table, Tokens};
use crate::geometry::curve::{Curve, Vec3};
use crate::geometry::nurbs::{MOST_DEGREE, Nurbs};
use crate::geometry::offset_curve::offset_curve;
use crate::geometry::periodic::unrolled;
use crate::geometry::vector::scaled;

/// Limit on the nesting of trimmed and offset curves and surfaces.
pub const MOST_NESTED: usize = 16;

pub fn section<T: Tokens>(
    tokens: &mut T,
    table: Table,
    one: fn(&mut T, usize) -> Read<Option<Curve>>,
) -> Read<Vec<Option<Curve>>> {
    let count = tokens.header(table, 2)?;
    (0..count).map(|_| one(tokens, 0)).collect()
}

/// A curve in space; None for a kind that is not supported.
pub fn space_curve(bytes: &mut impl Tokens, nested: usize) -> Read<Option<Curve>> {
    curve::<3>(bytes, nested)
}

/// A curve in (u, v), as a curve in space with z = 0.
pub fn plane_curve(bytes: &mut impl Tokens, nested: usize) -> Read<Option<Curve>> {
    curve::<2>(bytes, nested)
}

fn vector<const N: usize>(bytes: &mut impl Tokens) -> Read<Vec3> {
    Ok(spatial(bytes.reals::<N>()?))
}

fn spatial<const N: usize>(vector: [f64; N]) -> Vec3 {
    let mut out = [0.0; 3];
    out[..N].copy_from_slice(&vector);
    out
}

/// Origin and the directions of x and y; for a curve in space, the normal is written between them.
fn axes<const N: usize>(bytes: &mut impl Tokens) -> Read<(Vec3, Vec3, Vec3)> {
    let origin = vector::<N>(bytes)?;
    if N == 3 {
        let [_, x, y] = bytes.axes(false)?;
        return Ok((origin, x, y));
    }
    let [x, y] = bytes.plane_axes()?.map(spatial);
    Ok((origin, x, y))
}

fn curve<const N: usize>(bytes: &mut impl Tokens, nested: usize) -> Read<Option<Curve>> {
    Ok(Some(match bytes.kind()? {
        1 => Curve::Line { p: vector::<N>(bytes)?, a: spatial(bytes.direction::<N>()?) },
        2 => {
            let (p, x, y) = axes::<N>(bytes)?;
            let radius = bytes.finite()?;
            Curve::Ellipse { p, a: scaled(&x, radius), b: scaled(&y, radius) }
        }
        3 => {
            let (p, x, y) = axes::<N>(bytes)?;
            let [major, minor] = bytes.reals()?;
            Curve::Ellipse { p, a: scaled(&x, major), b: scaled(&y, minor) }
        }
        4 => {
            let (p, x, y) = axes::<N>(bytes)?;
            let focal = bytes.finite()?;
            let curve = Curve::Parabola { p, a: scaled(&x, 0.25 / focal), b: y };
            return Ok((focal != 0.0).then_some(curve));
        }
        5 => {
            let (p, x, y) = axes::<N>(bytes)?;
            let [major, minor] = bytes.reals()?;
            Curve::Hyperbola { p, a: scaled(&x, major), b: scaled(&y, minor) }
        }
        6 => {
            let rational = bytes.flag()?;
            let degree = degree(bytes)?;
            let poles = poles::<N>(bytes, degree + 1, rational)?;
            let knots = [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat();
            Curve::Spline(Nurbs { degree, rational, sampled: false, knots, poles })
        }
        7 => Curve::Spline(spline::<N>(bytes)?),
        8 => {
            bytes.real()?; // may be without end
            bytes.real()?;
            return basis::<N>(bytes, nested);
        }
        9 => {
            let distance = bytes.finite()?;
            let way = if N == 3 { bytes.direction::<3>()? } else { [0.0, 0.0, 1.0] };
            let basis = basis::<N>(bytes, nested)?;
            // In the plane an offset is to the right of the curve, in space along the tangent x the direction.
            return Ok(basis.and_then(|basis| offset_curve(&basis, distance, &way)));
        }
        _ => return bytes.unsupported("a curve of unknown kind"),
    }))
}

fn basis<const N: usize>(bytes: &mut impl Tokens, nested: usize) -> Read<Option<Curve>> {
    if nested == MOST_NESTED {
        return bytes.fault("curves nested too deep");
    }
    curve::<N>(bytes, nested + 1)
}

pub fn degree(bytes: &mut impl Tokens) -> Read<usize> {
    let degree = bytes.short()?;
    if (1..=MOST_DEGREE).contains(&degree) { Ok(degree) } else { bytes.unsupported("a degree out of range") }
}

fn poles<const N: usize>(bytes: &mut impl Tokens, count: usize, rational: bool) -> Read<Vec<[f64; 4]>> {
    (0..count).map(|_| pole::<N>(bytes, rational)).collect()
}

/// A pole times its weight, which follows it in the dump if the curve is rational.
pub fn pole<const N: usize>(bytes: &mut impl Tokens, rational: bool) -> Read<[f64; 4]> {
    let [x, y, z] = vector::<N>(bytes)?;
    let w = if rational { bytes.finite()? } else { 1.0 };
    if w <= 0.0 {
        return bytes.unsupported("a weight that is not positive");
    }
    Ok([x * w, y * w, z * w, w])
}

fn spline<const N: usize>(bytes: &mut impl Tokens) -> Read<Nurbs> {
    let (rational, periodic) = (bytes.flag()?, bytes.flag()?);
    let degree = degree(bytes)?;
    let poles = bytes.count(8 * N)?;
    let knots = bytes.count(12)?;
    let poles = self::poles::<N>(bytes, poles, rational)?;
    let axis = Axis::read(bytes, degree, poles.len(), knots, periodic)?;
    // One turn more on either side, so that an edge may begin in one turn and end in the next.
    let (knots, order) = axis.flat(degree, poles.len(), 1);
    Ok(Nurbs { degree, rational, sampled: false, knots, poles: order.iter().map(|&i| poles[i]).collect() })
}

/// Knots of one direction, each with its multiplicity.
pub struct Axis {
    knots: Vec<(f64, usize)>,
    periodic: bool,
}

impl Axis {
    pub fn read(bytes: &mut impl Tokens, degree: usize, poles: usize, count: usize, periodic: bool) -> Read<Axis> {
        let mut knots = Vec::new();
        for _ in 0..count {
            let value = bytes.finite()?;
            let times = bytes.integer()?;
            match usize::try_from(times) {
                Ok(times) if (1..=degree + 1).contains(&times) => knots.push((value, times)),
                _ => return bytes.unsupported("a knot that stands too often"),
            }
        }
        let total: usize = knots.iter().map(|k| k.1).sum();
        let last = knots.last().map_or(0, |k| k.1);
        let wanted = if periodic { total - last } else { total.saturating_sub(degree + 1) };
        if knots.len() < 2 || wanted != poles || poles == 0 || knots.windows(2).any(|w| w[0].0 >= w[1].0) {
            return bytes.unsupported("knots that do not fit their poles");
        }
        if !periodic && poles <= degree {
            return bytes.unsupported("too few poles");
        }
        if periodic && (last > degree || knots[0].1 != last) {
            return bytes.unsupported("knots that do not come round");
        }
        let axis = Axis { knots, periodic };
        let (flat, order) = axis.flat(degree, poles, 0);
        if flat[degree] >= flat[order.len()] {
            return bytes.unsupported("knots without a domain");
        }
        Ok(axis)
    }

    /// The period; 0 where it is not periodic.
    pub fn period(&self) -> f64 {
        if self.periodic { self.knots[self.knots.len() - 1].0 - self.knots[0].0 } else { 0.0 }
    }

    /// All knots, repeated by multiplicity, and the pole of each basis function. A periodic spline is unrolled, with
    /// `more` additional turns on either side.
    pub fn flat(&self, degree: usize, poles: usize, more: usize) -> (Vec<f64>, Vec<usize>) {
        let flat: Vec<f64> = self.knots.iter().flat_map(|&(value, times)| std::iter::repeat_n(value, times)).collect();
        if !self.periodic {
            return (flat, (0..poles).collect());
        }
        unrolled(&flat[..poles], self.knots[0].1, self.period(), degree, more)
    }
}
