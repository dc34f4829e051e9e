//! Reads the section of underlying shapes (TShapes).

use smallvec::SmallVec;

use super::orientation::Orientation;
use super::tokens::{FLAGS, Read, Table, Tokens};

/// A shape inside another one: its number, orientation and location.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sub {
    pub shape: u32,
    pub orientation: Orientation,
    pub location: u32,
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
    Face {
        tolerance: f64,
        surface: Option<usize>,
        location: u32,
        triangulation: Option<usize>,
    },
    Wire,
    /// on: where its geometry begins and ends in the table of all (`Dump::on`).
    Edge {
        tolerance: f64,
        same_parameter: bool,
        degenerate: bool,
        on: [u32; 2],
        continuity: u8,
    },
    Vertex {
        tolerance: f64,
        point: [f64; 3],
    },
}

/// The shapes inside a shape: an edge has two, most faces one.
pub type Subs = SmallVec<[Sub; 2]>;

#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    pub kind: Kind,
    pub subs: Subs,
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
}

pub fn read(bytes: &mut impl Tokens, limits: &Limits) -> Read<(Vec<Shape>, Vec<On>, Sub)> {
    let count = bytes.header(Table::Shapes, 1 + FLAGS + 1)?;
    let (mut shapes, mut on): (Vec<Shape>, Vec<On>) = Default::default();
    for number in 0..count {
        let kind = match bytes.shape()? {
            0 => Kind::Compound,
            1 => Kind::CompSolid,
            2 => Kind::Solid,
            3 => Kind::Shell,
            4 => face(bytes, limits)?,
            5 => Kind::Wire,
            6 => edge(bytes, limits, &mut on)?,
            7 => vertex(bytes, limits)?,
            _ => return bytes.fault("a shape of unknown kind"),
        };
        bytes.flags()?;
        let mut subs = Subs::new();
        while let Some(sub) = sub(bytes, count, limits)? {
            // A shape may refer only to shapes before it, so it cannot contain itself.
            if sub.shape as usize >= number || !may_hold(&kind, &shapes[sub.shape as usize].kind) {
                return bytes.unsupported("a shape where it cannot be");
            }
            subs.push(sub);
        }
        shapes.push(Shape { kind, subs });
    }
    match sub(bytes, count, limits)? {
        Some(root) => Ok((shapes, on, root)),
        None => bytes.fault("a dump of nothing"),
    }
}

/// Whether a shape of one kind can be in one of another.
pub fn may_hold(outer: &Kind, inner: &Kind) -> bool {
    match outer {
        Kind::Compound => true,
        Kind::CompSolid | Kind::Solid | Kind::Shell => !matches!(inner, Kind::Compound),
        Kind::Face { .. } => matches!(inner, Kind::Wire | Kind::Edge { .. } | Kind::Vertex { .. }),
        Kind::Wire => matches!(inner, Kind::Edge { .. } | Kind::Vertex { .. }),
        Kind::Edge { .. } => matches!(inner, Kind::Vertex { .. }),
        Kind::Vertex { .. } => false,
    }
}

fn sub(bytes: &mut impl Tokens, count: usize, limits: &Limits) -> Read<Option<Sub>> {
    let Some(orientation) = bytes.orientation()? else { return Ok(None) };
    // Shapes are numbered from the last one. Where there is none, every number is a fault.
    let from_last = bytes.index(Table::Shapes, count)?;
    let shape = (count - 1 - from_last) as u32;
    Ok(Some(Sub { shape, orientation, location: location(bytes, limits)? }))
}

/// The number of a location; 0 is the identity.
fn location(bytes: &mut impl Tokens, limits: &Limits) -> Read<u32> {
    match usize::try_from(bytes.number(Table::Locations)?) {
        Ok(number) if number < limits.locations => Ok(number as u32),
        _ => bytes.fault("a reference to nothing"),
    }
}

fn vertex(bytes: &mut impl Tokens, limits: &Limits) -> Read<Kind> {
    let tolerance = bytes.finite()?;
    let point = bytes.reals()?;
    // Parameters of the vertex on curves and surfaces are skipped: the edges give its place.
    loop {
        match bytes.place()?.0 {
            0 => return Ok(Kind::Vertex { tolerance, point }),
            1 => {
                bytes.maybe_index(Table::Curves, limits.curves)?;
            }
            2 => {
                bytes.maybe_index(Table::Curves2, limits.curves2)?;
                bytes.maybe_index(Table::Surfaces, limits.surfaces)?;
            }
            3 => {
                bytes.real()?;
                bytes.maybe_index(Table::Surfaces, limits.surfaces)?;
            }
            _ => return bytes.fault("a vertex on something unknown"),
        }
        location(bytes, limits)?;
    }
}

/// An edge; its geometry is added to `on`.
fn edge(bytes: &mut impl Tokens, limits: &Limits, on: &mut Vec<On>) -> Read<Kind> {
    let tolerance = bytes.finite()?;
    let (same_parameter, _same_range, degenerate) = (bytes.flag()?, bytes.flag()?, bytes.flag()?);
    let (first, mut continuity) = (on.len() as u32, 0);
    loop {
        let kind = bytes.representation()?;
        match kind {
            0 => {
                let on = [first, on.len() as u32];
                return Ok(Kind::Edge { tolerance, same_parameter, degenerate, on, continuity });
            }
            1 => {
                let curve = bytes.maybe_index(Table::Curves, limits.curves)?;
                let location = location(bytes, limits)?;
                let range = [bytes.real()?, bytes.real()?];
                if let Some(curve) = curve {
                    on.push(On::Curve { curve, location, range });
                }
            }
            2 | 3 => {
                let one = bytes.index(Table::Curves2, limits.curves2)?;
                let two = if kind == 3 { bytes.index(Table::Curves2, limits.curves2)? } else { one };
                if kind == 3 {
                    bytes.continuity()?;
                }
                let surface = bytes.index(Table::Surfaces, limits.surfaces)?;
                let location = location(bytes, limits)?;
                let range = [bytes.real()?, bytes.real()?];
                bytes.skip_ends()?;
                on.push(On::Surface { curves: [one, two], surface, location, range });
            }
            4 => {
                continuity = continuity.max(1 + bytes.continuity()?.min(100));
                for _ in 0..2 {
                    bytes.maybe_index(Table::Surfaces, limits.surfaces)?;
                    location(bytes, limits)?;
                }
            }
            5 => {
                let polygon = bytes.index(Table::Polygons, limits.polygons)?;
                on.push(On::Polygon { polygon, location: location(bytes, limits)? });
            }
            6 | 7 => {
                for _ in 0..kind - 5 {
                    bytes.index(Table::OnTriangles, limits.on_triangles)?;
                }
                bytes.index(Table::Triangulations, limits.triangulations)?;
                location(bytes, limits)?;
            }
            _ => return bytes.fault("an edge on something unknown"),
        }
    }
}

fn face(bytes: &mut impl Tokens, limits: &Limits) -> Read<Kind> {
    bytes.flag()?;
    let tolerance = bytes.finite()?;
    let surface = bytes.maybe_index(Table::Surfaces, limits.surfaces)?;
    let location = location(bytes, limits)?;
    let number = bytes.own_triangles(surface.is_some())?;
    let triangulation = bytes.counted(number, limits.triangulations)?;
    Ok(Kind::Face { tolerance, surface, location, triangulation })
}
