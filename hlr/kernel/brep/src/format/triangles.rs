//! Reads the sections of polygons and triangulations, which a file may have in place of curves and surfaces.

use super::tokens::{Read, Table, Tokens};

/// A face's own triangles; uv is empty if the file has none.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangulation {
    pub points: Vec<[f64; 3]>,
    pub uv: Vec<[f64; 2]>,
    pub triangles: Vec<[u32; 3]>,
}

pub fn polygons(bytes: &mut impl Tokens) -> Read<Vec<Vec<[f64; 3]>>> {
    let count = bytes.header(Table::Polygons, 13)?;
    let one = |_| {
        let size = bytes.count(24)?;
        let parameters = bytes.flag()?;
        bytes.real()?;
        let points = (0..size).map(|_| bytes.reals()).collect::<Read<Vec<_>>>()?;
        for _ in 0..if parameters { size } else { 0 } {
            bytes.real()?;
        }
        Ok(points)
    };
    (0..count).map(one).collect()
}

/// Skips polygons on triangulations, and returns their number.
pub fn skip_polygons_on_triangulations(bytes: &mut impl Tokens) -> Read<usize> {
    let count = bytes.header(Table::OnTriangles, 13)?;
    for _ in 0..count {
        bytes.skip_polygon_on_triangles()?;
    }
    Ok(count)
}

pub fn triangulations<T: Tokens>(bytes: &mut T) -> Read<Vec<Triangulation>> {
    let count = bytes.header(Table::Triangulations, 17)?;
    let one = |_| {
        let (nodes, triangles, has_uv, has_normals) = bytes.triangulation()?;
        let points = (0..nodes).map(|_| bytes.reals()).collect::<Read<Vec<_>>>()?;
        let uv = (0..if has_uv { nodes } else { 0 }).map(|_| bytes.reals()).collect::<Read<Vec<_>>>()?;
        let corner = |bytes: &mut T| match usize::try_from(bytes.integer()?) {
            Ok(number) if (1..=nodes).contains(&number) => Ok(number as u32 - 1),
            _ => bytes.fault("a triangle of points that there are not"),
        };
        let triangles =
            (0..triangles).map(|_| Ok([corner(bytes)?, corner(bytes)?, corner(bytes)?])).collect::<Read<Vec<_>>>()?;
        bytes.skip_normals(if has_normals { nodes } else { 0 })?;
        Ok(Triangulation { points, uv, triangles })
    };
    (0..count).map(one).collect()
}
