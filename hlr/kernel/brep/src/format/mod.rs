//! OpenCASCADE's dump of a shape, read without OpenCASCADE: binary (BinTools, layouts 2 to 4) and text (BREP, versions 1
//! to 3). One reader knows what a dump is made of; `bytes` and `text` know how that is written. `stream` reads the same from one pass over a shape, without tables.
//!
//! ```text
//! Locations, Curve2ds, Curves, Polygon3D, PolygonOnTriangulations, Surfaces, Triangulations, TShapes, root
//! ```
//!
//! The bytes are not trusted: anything but a dump gives an error, counts are compared with the remaining bytes before
//! memory is allocated, and nesting is limited.

mod bytes;
mod curves;
mod dump;
mod locations;
mod merge;
mod orientation;
mod pieces;
mod record;
mod shapes;
mod square;
mod stream;
mod surfaces;
mod text;
mod tokens;
mod triangles;

pub use dump::Dump;
pub use locations::{IDENTITY, Locations, MOST_FACTORS, Matrix, chained, determinant, inverted, moved, turned};
pub use merge::{Root, Source, merged};
pub use orientation::Orientation;
pub use pieces::{Piece, faces, pieces, pieces_of};
pub use shapes::{Kind, On, Shape, Sub};
pub use square::square_placement;
pub use surfaces::SurfaceRecord;
pub use tokens::Damaged;
pub use triangles::Triangulation;

use bytes::Bytes;
use record::Recorder;
use text::Text;
use tokens::{Read, Table, Tokens};

/// Reads the shape of a dump, or of a stream of shapes.
///
/// # Errors
/// The bytes are no dump in a supported layout.
pub fn read(data: &[u8]) -> Read<Dump> {
    if data.first().is_some_and(|first| stream::SHAPES.contains(first)) {
        return stream::read(data);
    }
    dump(&mut Bytes::new(data)?)
}

/// Reads the shape of a BREP file, text or binary, and records it in binary. `stopped`: whether to give up.
///
/// # Errors
/// The bytes are none.
pub fn read_file(data: &[u8], stopped: &dyn Fn() -> bool) -> Read<Source> {
    if data[..data.len().min(HEAD)].windows(BINARY.len()).any(|head| head == BINARY) {
        recorded(Bytes::new(data)?)
    } else {
        recorded(Text::new(data, stopped)?)
    }
}

/// What the head of a binary file has.
const BINARY: &[u8] = b"Open CASCADE Topology V";
const HEAD: usize = 200;

fn recorded(tokens: impl Tokens) -> Read<Source> {
    let mut recorder = Recorder::new(tokens);
    Ok(Source { dump: dump(&mut recorder)?, recorded: recorder.recorded })
}

fn dump(tokens: &mut impl Tokens) -> Read<Dump> {
    let locations = locations::read(tokens)?;
    let curves2 = curves::section(tokens, Table::Curves2, curves::plane_curve)?;
    let curves = curves::section(tokens, Table::Curves, curves::space_curve)?;
    let polygons = triangles::polygons(tokens)?;
    let on_triangles = triangles::skip_polygons_on_triangulations(tokens)?;
    let surfaces = surfaces::section(tokens)?;
    let triangulations = triangles::triangulations(tokens)?;
    let limits = shapes::Limits {
        locations: locations.count(),
        curves2: curves2.len(),
        curves: curves.len(),
        polygons: polygons.len(),
        on_triangles,
        surfaces: surfaces.len(),
        triangulations: triangulations.len(),
    };
    let (shapes, on, root) = shapes::read(tokens, &limits)?;
    Ok(Dump { locations, curves2, curves, polygons, surfaces, triangulations, shapes, on, root })
}

#[cfg(test)]
mod tests;
