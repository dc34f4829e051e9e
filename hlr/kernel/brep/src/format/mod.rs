//! OpenCASCADE's binary dump of a shape (BinTools), layouts 2 to 4, read without OpenCASCADE.
//!
//! ```text
//! Locations, Curve2ds, Curves, Polygon3D, PolygonOnTriangulations, Surfaces, Triangulations, TShapes, root
//! ```
//!
//! The bytes are not trusted: anything but a dump gives an error, counts are compared with the remaining bytes before
//! memory is allocated, and nesting is limited.

mod bytes;
mod curves;
mod layout;
mod locations;
mod shapes;
mod surfaces;
mod triangles;

pub use bytes::Damaged;
pub use locations::{IDENTITY, Locations, Matrix, chained, determinant, inverted, moved, turned};
pub use shapes::{Kind, On, Orientation, Shape, Sub};
pub use surfaces::SurfaceRecord;
pub use triangles::Triangulation;

use crate::geometry::curve::Curve;
use bytes::{Bytes, Read};
use layout::Layout;

/// The content of a dump. Underlying shapes come before the shapes that contain them.
pub struct Dump {
    pub locations: Locations,
    /// Curves in (u, v), as curves in space with z = 0; None for a kind that is not supported.
    pub curves2: Vec<Option<Curve>>,
    pub curves: Vec<Option<Curve>>,
    /// Polygons in space.
    pub polygons: Vec<Vec<[f64; 3]>>,
    pub surfaces: Vec<Option<SurfaceRecord>>,
    pub triangulations: Vec<Triangulation>,
    pub shapes: Vec<Shape>,
    pub root: Sub,
}

/// Reads the shape of a dump.
///
/// # Errors
/// The bytes are no dump in a supported layout.
pub fn read(data: &[u8]) -> Read<Dump> {
    let mut bytes = Bytes::new(data);
    let mut version = bytes.line()?;
    if version.is_empty() {
        version = bytes.line()?;
    }
    let layout = match version.strip_prefix(b"Open CASCADE Topology V").and_then(<[u8]>::first) {
        Some(b'2' | b'3') => Layout { ends_in_uv: true, normals: false },
        Some(b'4') => Layout { ends_in_uv: false, normals: true },
        _ => return bytes.fault("not a dump in a layout that is known here"),
    };
    let locations = locations::read(&mut bytes)?;
    let curves2 = curves::section(&mut bytes, "Curve2ds", curves::plane_curve)?;
    let curves = curves::section(&mut bytes, "Curves", curves::space_curve)?;
    let polygons = triangles::polygons(&mut bytes)?;
    let on_triangles = triangles::skip_polygons_on_triangulations(&mut bytes)?;
    let surfaces = surfaces::section(&mut bytes)?;
    let triangulations = triangles::triangulations(&mut bytes, layout)?;
    bytes.line()?;
    let limits = shapes::Limits {
        locations: locations.count(),
        curves2: curves2.len(),
        curves: curves.len(),
        polygons: polygons.len(),
        on_triangles,
        surfaces: surfaces.len(),
        triangulations: triangulations.len(),
        layout,
    };
    let (shapes, root) = shapes::read(&mut bytes, &limits)?;
    Ok(Dump { locations, curves2, curves, polygons, surfaces, triangulations, shapes, root })
}

#[cfg(test)]
mod tests;
