//! Reads the section of surfaces.

use super::curves::{Axis, MOST_NESTED, degree, pole, space_curve};
use super::tokens::{Read, Table, Tokens};
use crate::geometry::curve::Curve;

/// A surface as numbers, as `Surface::read` and other parts of the kernel take them.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceRecord {
    pub kind: u8,
    pub data: Vec<f64>,
}

pub fn section(bytes: &mut impl Tokens) -> Read<Vec<Option<SurfaceRecord>>> {
    let count = bytes.header(Table::Surfaces, 2)?;
    (0..count).map(|_| surface(bytes, 0)).collect()
}

/// Origin, then the directions of x, y and z; in the dump z comes before x and y.
fn frame(bytes: &mut impl Tokens) -> Read<Vec<f64>> {
    let origin = bytes.reals::<3>()?;
    let [z, x, y] = bytes.axes(true)?;
    // Capacity for two radii as well.
    let mut data = Vec::with_capacity(14);
    data.extend([origin, x, y, z].as_flattened());
    Ok(data)
}

fn with_frame<const N: usize>(bytes: &mut impl Tokens, kind: u8) -> Read<Option<SurfaceRecord>> {
    let mut data = frame(bytes)?;
    data.extend(bytes.reals::<N>()?);
    Ok(Some(SurfaceRecord { kind, data }))
}

fn swept(kind: u8, mut data: Vec<f64>, curve: Option<Curve>) -> Option<SurfaceRecord> {
    let curve = curve?;
    let at = data.len();
    data.push(0.0);
    data[at] = f64::from(curve.record(&mut data));
    Some(SurfaceRecord { kind, data })
}

/// None for a kind that is not supported.
pub fn surface(bytes: &mut impl Tokens, nested: usize) -> Read<Option<SurfaceRecord>> {
    if nested > MOST_NESTED {
        return bytes.fault("surfaces nested too deep");
    }
    match bytes.kind()? {
        1 => with_frame::<0>(bytes, 1),
        2 => with_frame::<1>(bytes, 2),
        3 => with_frame::<2>(bytes, 3),
        4 => with_frame::<1>(bytes, 4),
        5 => with_frame::<2>(bytes, 5),
        6 => {
            let way = bytes.direction::<3>()?.to_vec();
            Ok(swept(7, way, space_curve(bytes, nested)?))
        }
        7 => {
            let axis = [bytes.reals::<3>()?, bytes.direction()?].concat();
            Ok(swept(6, axis, space_curve(bytes, nested)?))
        }
        8 => bezier(bytes).map(Some),
        9 => spline(bytes).map(Some),
        10 => {
            for _ in 0..4 {
                bytes.real()?; // may be without end
            }
            surface(bytes, nested + 1)
        }
        11 => {
            let distance = bytes.finite()?;
            let basis = surface(bytes, nested + 1)?;
            Ok(basis.map(|basis| SurfaceRecord {
                kind: 9,
                data: [&[distance, f64::from(basis.kind)], &basis.data[..]].concat(),
            }))
        }
        _ => bytes.unsupported("a surface of unknown kind"),
    }
}

fn bezier(bytes: &mut impl Tokens) -> Read<SurfaceRecord> {
    let rational = bytes.flag()? | bytes.flag()?;
    let (u, v) = (degree(bytes)?, degree(bytes)?);
    let mut data = vec![u as f64, v as f64, u as f64 + 1.0, v as f64 + 1.0, 0.0, 0.0];
    for degree in [u, v] {
        data.extend(std::iter::repeat_n(0.0, degree + 1).chain(std::iter::repeat_n(1.0, degree + 1)));
    }
    for _ in 0..(u + 1) * (v + 1) {
        let [x, y, z, w] = pole::<3>(bytes, rational)?;
        data.extend([x / w, y / w, z / w, w]);
    }
    Ok(SurfaceRecord { kind: 8, data })
}

fn spline(bytes: &mut impl Tokens) -> Read<SurfaceRecord> {
    let rational = bytes.flag()? | bytes.flag()?;
    let periodic = [bytes.flag()?, bytes.flag()?];
    let degrees = [degree(bytes)?, degree(bytes)?];
    let counts = [bytes.count(24)?, bytes.count(24)?];
    let knots = [bytes.count(12)?, bytes.count(12)?];
    let all = counts[0].checked_mul(counts[1]).and_then(|n| i32::try_from(n).ok()).unwrap_or(-1);
    let all = bytes.fitting(all, 24)?;
    let poles = (0..all).map(|_| pole::<3>(bytes, rational)).collect::<Read<Vec<_>>>()?;
    let mut read = |k: usize| Axis::read(bytes, degrees[k], counts[k], knots[k], periodic[k]);
    let axes = [read(0)?, read(1)?];
    let [(u, rows), (v, columns)] = [0, 1].map(|k| axes[k].flat(degrees[k], counts[k], 0));
    let [du, dv] = degrees.map(|d| d as f64);
    let mut data = vec![du, dv, rows.len() as f64, columns.len() as f64, axes[0].period(), axes[1].period()];
    data.extend(u);
    data.extend(v);
    for row in rows {
        for &column in &columns {
            let [x, y, z, w] = poles[row * counts[1] + column];
            data.extend([x / w, y / w, z / w, w]);
        }
    }
    Ok(SurfaceRecord { kind: 8, data })
}
