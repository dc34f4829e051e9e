//! Reads the section of underlying shapes (TShapes).

use super::bytes::{Bytes, Read};
use super::layout::Layout;

/// A shape inside another one: its number, orientation and location.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sub {
    pub shape: u32,
    pub orientation: Orientation,
    pub location: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    Forward,
    Reversed,
    Internal,
    External,
}

impl Orientation {
    /// Whether a shape of this orientation bounds the shape that contains it.
    pub fn bounds(self) -> bool {
        matches!(self, Orientation::Forward | Orientation::Reversed)
    }

    /// The orientation of a child, seen from the frame of its parent. Internal and external children keep theirs; a
    /// reversed parent reverses the others.
    pub fn compose(self, inner: Orientation) -> Orientation {
        use Orientation::{Forward, Reversed};
        match (self, inner) {
            (Forward, inner) => inner,
            (Reversed, Forward) => Reversed,
            (Reversed, Reversed) => Forward,
            (Reversed, inner) => inner,
            (outer, _) => outer,
        }
    }
}

/// The geometry of an edge, besides the continuity of the surfaces across it.
#[derive(Clone, Debug, PartialEq)]
pub enum On {
    /// A curve in space.
    Curve { curve: usize, location: u32, range: [f64; 2] },
    /// Curves in (u, v) of a surface. For a seam the second curve is that of the reversed edge.
    Surface { curves: [usize; 2], surface: usize, location: u32, range: [f64; 2] },
    /// A polygon in space.
    Polygon { polygon: usize, location: u32 },
}

#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    Compound,
    CompSolid,
    Solid,
    Shell,
    Face { tolerance: f64, surface: Option<usize>, location: u32, triangulation: Option<usize> },
    Wire,
    Edge { tolerance: f64, same_parameter: bool, degenerate: bool, on: Vec<On>, continuity: u8 },
    Vertex { tolerance: f64, point: [f64; 3] },
}

#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    pub kind: Kind,
    pub subs: Vec<Sub>,
}

/// Number of items of each kind that a shape may refer to.
pub struct Limits {
    pub locations: usize,
    pub curves2: usize,
    pub curves: usize,
    pub polygons: usize,
    pub on_triangles: usize,
    pub surfaces: usize,
    pub triangulations: usize,
    pub layout: Layout,
}

const FLAGS: usize = 7;

pub fn read(bytes: &mut Bytes, limits: &Limits) -> Read<(Vec<Shape>, Sub)> {
    let count = bytes.header("TShapes", 1 + FLAGS + 1)?;
    let mut shapes: Vec<Shape> = Vec::with_capacity(count);
    for number in 0..count {
        let kind = match bytes.byte()? {
            0 => Kind::Compound,
            1 => Kind::CompSolid,
            2 => Kind::Solid,
            3 => Kind::Shell,
            4 => face(bytes, limits)?,
            5 => Kind::Wire,
            6 => edge(bytes, limits)?,
            7 => vertex(bytes, limits)?,
            _ => return bytes.fault("a shape of unknown kind"),
        };
        bytes.skip(FLAGS)?;
        let mut subs = Vec::new();
        while let Some(sub) = sub(bytes, count, limits)? {
            // A shape may refer only to shapes before it, so it cannot contain itself.
            if sub.shape as usize >= number || !may_hold(&kind, &shapes[sub.shape as usize].kind) {
                return bytes.fault("a shape where it cannot be");
            }
            subs.push(sub);
        }
        shapes.push(Shape { kind, subs });
    }
    match sub(bytes, count, limits)? {
        Some(root) => Ok((shapes, root)),
        None => bytes.fault("a dump of nothing"),
    }
}

fn may_hold(outer: &Kind, inner: &Kind) -> bool {
    match outer {
        Kind::Compound => true,
        Kind::CompSolid | Kind::Solid | Kind::Shell => !matches!(inner, Kind::Compound),
        Kind::Face { .. } => matches!(inner, Kind::Wire | Kind::Edge { .. } | Kind::Vertex { .. }),
        Kind::Wire => matches!(inner, Kind::Edge { .. } | Kind::Vertex { .. }),
        Kind::Edge { .. } => matches!(inner, Kind::Vertex { .. }),
        Kind::Vertex { .. } => false,
    }
}

fn sub(bytes: &mut Bytes, count: usize, limits: &Limits) -> Read<Option<Sub>> {
    let orientation = match bytes.byte()? {
        0 => Orientation::Forward,
        1 => Orientation::Reversed,
        2 => Orientation::Internal,
        3 => Orientation::External,
        b'*' => return Ok(None),
        _ => return bytes.fault("an orientation that there is not"),
    };
    // Shapes are numbered from the last one.
    let shape = (count - 1 - bytes.index(count)?) as u32;
    Ok(Some(Sub { shape, orientation, location: location(bytes, limits)? }))
}

/// The number of a location; 0 is the identity.
fn location(bytes: &mut Bytes, limits: &Limits) -> Read<u32> {
    match usize::try_from(bytes.integer()?) {
        Ok(number) if number < limits.locations => Ok(number as u32),
        _ => bytes.fault("a reference to nothing"),
    }
}

fn vertex(bytes: &mut Bytes, limits: &Limits) -> Read<Kind> {
    let tolerance = bytes.finite()?;
    let point = bytes.reals()?;
    // Parameters of the vertex on curves and surfaces are skipped: the edges give its place.
    loop {
        match bytes.byte()? {
            0 => return Ok(Kind::Vertex { tolerance, point }),
            1 => {
                bytes.skip(8)?;
                bytes.maybe_index(limits.curves)?;
            }
            2 => {
                bytes.skip(8)?;
                bytes.maybe_index(limits.curves2)?;
                bytes.maybe_index(limits.surfaces)?;
            }
            3 => {
                bytes.skip(16)?;
                bytes.maybe_index(limits.surfaces)?;
            }
            _ => return bytes.fault("a vertex on something unknown"),
        }
        location(bytes, limits)?;
    }
}

fn edge(bytes: &mut Bytes, limits: &Limits) -> Read<Kind> {
    let tolerance = bytes.finite()?;
    let (same_parameter, _same_range, degenerate) = (bytes.flag()?, bytes.flag()?, bytes.flag()?);
    let (mut on, mut continuity) = (Vec::new(), 0);
    loop {
        let kind = bytes.byte()?;
        match kind {
            0 => return Ok(Kind::Edge { tolerance, same_parameter, degenerate, on, continuity }),
            1 => {
                let curve = bytes.maybe_index(limits.curves)?;
                let location = location(bytes, limits)?;
                let range = [bytes.real()?, bytes.real()?];
                if let Some(curve) = curve {
                    on.push(On::Curve { curve, location, range });
                }
            }
            2 | 3 => {
                let one = bytes.index(limits.curves2)?;
                let two = if kind == 3 { bytes.index(limits.curves2)? } else { one };
                if kind == 3 {
                    bytes.byte()?;
                }
                let surface = bytes.index(limits.surfaces)?;
                let location = location(bytes, limits)?;
                let range = [bytes.real()?, bytes.real()?];
                if limits.layout.ends_in_uv {
                    bytes.skip(32)?;
                }
                on.push(On::Surface { curves: [one, two], surface, location, range });
            }
            4 => {
                continuity = continuity.max(1 + bytes.byte()?.min(100));
                for _ in 0..2 {
                    bytes.maybe_index(limits.surfaces)?;
                    location(bytes, limits)?;
                }
            }
            5 => {
                let polygon = bytes.index(limits.polygons)?;
                on.push(On::Polygon { polygon, location: location(bytes, limits)? });
            }
            6 | 7 => {
                for _ in 0..kind - 5 {
                    bytes.index(limits.on_triangles)?;
                }
                bytes.index(limits.triangulations)?;
                location(bytes, limits)?;
            }
            _ => return bytes.fault("an edge on something unknown"),
        }
    }
}

fn face(bytes: &mut Bytes, limits: &Limits) -> Read<Kind> {
    bytes.flag()?;
    let tolerance = bytes.finite()?;
    let surface = bytes.maybe_index(limits.surfaces)?;
    let location = location(bytes, limits)?;
    let triangulation = match bytes.byte()? {
        0 | 1 => None,
        2 => Some(bytes.index(limits.triangulations)?),
        _ => return bytes.fault("a face of unknown kind"),
    };
    Ok(Kind::Face { tolerance, surface, location, triangulation })
}
