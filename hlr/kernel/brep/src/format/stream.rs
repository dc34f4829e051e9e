//! A stream of shapes (BinTools_ShapeWriter): every shape, location, curve and surface stands where it is first needed,
//! and later ones refer back to it. OpenCASCADE writes it in half the time that a dump with tables takes. It has no
//! header: it begins with a shape.
//!
//! ```text
//! compound  location  flags
//!     solid  location  flags  ...  end
//!     <- 412  location  orientation        the shape that began 412 bytes before
//! end
//! ```

use rustc_hash::{FxBuildHasher, FxHashMap};

use super::bytes::Bytes;
use super::curves::{plane_curve, space_curve};
use super::dump::Dump;
use super::locations::Locations;
use super::orientation::Orientation;
use super::shapes::{Kind, On, Shape, Sub, Subs, may_hold};
use super::surfaces::{SurfaceRecord, surface};
use super::tokens::{Read, Tokens};
use crate::geometry::curve::Curve;

/// What stands next.
const BACK: std::ops::RangeInclusive<u8> = 1..=4;
const LOCATION: u8 = 5;
const ONE_MOVE: u8 = 6;
const NOT_MOVED: u8 = 7;
const LOCATION_END: u8 = 8;
const CURVE: u8 = 9;
const NO_CURVE: u8 = 10;
const CURVE2: u8 = 11;
const NO_CURVE2: u8 = 12;
const SURFACE: u8 = 13;
const NO_SURFACE: u8 = 14;
const END: u8 = 199;
/// Shapes: four for each kind, one for each orientation.
pub const SHAPES: std::ops::Range<u8> = 200..232;

/// Limit on the nesting of shapes.
const DEEPEST: usize = 200;

/// A shape takes about as many bytes of a stream, with its geometry.
const BYTES_OF_A_SHAPE: usize = 128;

/// Numbers by the places at which their items begin.
type Places = FxHashMap<usize, usize>;

struct Stream<'a> {
    bytes: Bytes<'a>,
    dump: Dump,
    shapes: Places,
    locations: Places,
    curves: Places,
    curves2: Places,
    surfaces: Places,
}

/// Reads a stream of one shape.
///
/// # Errors
/// The bytes are none, or hold triangles or what the kernel does not take; OpenCASCADE's dump with tables may be read.
pub fn read(data: &[u8]) -> Read<Dump> {
    let root = Sub { shape: 0, orientation: Orientation::Forward, location: 0 };
    let dump = Dump {
        locations: Locations::none(),
        curves2: Vec::new(),
        curves: Vec::new(),
        polygons: Vec::new(),
        surfaces: Vec::new(),
        triangulations: Vec::new(),
        shapes: Vec::with_capacity(data.len() / BYTES_OF_A_SHAPE),
        on: Vec::new(),
        root,
    };
    let [locations, curves, curves2, surfaces] = std::array::from_fn(|_| Places::default());
    let shapes = Places::with_capacity_and_hasher(data.len() / BYTES_OF_A_SHAPE, FxBuildHasher);
    let bytes = Bytes::without_header(data);
    let mut stream = Stream { bytes, dump, shapes, locations, curves, curves2, surfaces };
    match stream.shape(0)? {
        Some(root) => Ok(Dump { root, ..stream.dump }),
        None => stream.bytes.fault("a stream of nothing"),
    }
}

impl Stream<'_> {
    /// The place of what a reference refers to: `kind` stands at `here`.
    fn back(&mut self, kind: u8, here: usize) -> Read<usize> {
        let distance = self.bytes.unsigned(1 << (kind - 1))?;
        match usize::try_from(distance).ok().and_then(|distance| here.checked_sub(distance)) {
            Some(place) => Ok(place),
            None => self.bytes.fault("a reference to nothing"),
        }
    }

    fn known(&mut self, kind: u8, here: usize, of: fn(&Self) -> &Places) -> Read<usize> {
        let place = self.back(kind, here)?;
        match of(self).get(&place) {
            Some(&number) => Ok(number),
            None => self.bytes.fault("a reference to nothing"),
        }
    }

    /// The next shape; None at the end of the shapes that another one holds.
    fn shape(&mut self, nested: usize) -> Read<Option<Sub>> {
        let here = self.bytes.at();
        let code = self.bytes.kind()?;
        if code == END {
            return Ok(None);
        }
        if BACK.contains(&code) {
            let shape = self.known(code, here, |s| &s.shapes)? as u32;
            let location = self.location()?;
            let orientation = self.bytes.kind()?;
            return Ok(Some(Sub { shape, orientation: self.orientation(orientation)?, location }));
        }
        if !SHAPES.contains(&code) {
            return self.bytes.unsupported("a shape of unknown kind");
        }
        if nested == DEEPEST {
            return self.bytes.unsupported("shapes nested too deep");
        }
        let orientation = self.orientation((code - SHAPES.start) % 4)?;
        let location = self.location()?;
        let kind = match (code - SHAPES.start) / 4 {
            0 => Kind::Compound,
            1 => Kind::CompSolid,
            2 => Kind::Solid,
            3 => Kind::Shell,
            4 => self.face()?,
            5 => Kind::Wire,
            6 => self.edge()?,
            _ => self.vertex()?,
        };
        self.bytes.kind()?; // flags
        let mut subs = Subs::new();
        while let Some(sub) = self.shape(nested + 1)? {
            if !may_hold(&kind, &self.dump.shapes[sub.shape as usize].kind) {
                return self.bytes.unsupported("a shape where it cannot be");
            }
            subs.push(sub);
        }
        // A shape is known only behind its end, so it cannot contain itself.
        let shape = self.dump.shapes.len();
        self.shapes.insert(here, shape);
        self.dump.shapes.push(Shape { kind, subs });
        Ok(Some(Sub { shape: shape as u32, orientation, location }))
    }

    fn orientation(&self, named: u8) -> Read<Orientation> {
        Ok(match named {
            0 => Orientation::Forward,
            1 => Orientation::Reversed,
            2 => Orientation::Internal,
            3 => Orientation::External,
            _ => return self.bytes.fault("an orientation that there is not"),
        })
    }

    /// The number of a location among those that are written; 0 is the identity.
    fn location(&mut self) -> Read<u32> {
        let here = self.bytes.at();
        let code = self.bytes.kind()?;
        self.location_of(code, here, true)
    }

    fn location_of(&mut self, code: u8, here: usize, composed: bool) -> Read<u32> {
        let number = match code {
            NOT_MOVED => return Ok(0),
            code if BACK.contains(&code) => return Ok(self.known(code, here, |s| &s.locations)? as u32),
            ONE_MOVE => {
                let place = self.bytes.placement()?;
                self.dump.locations.add_move(place)
            }
            LOCATION if composed => {
                let mut factors = Vec::new();
                loop {
                    let here = self.bytes.at();
                    match self.bytes.kind()? {
                        LOCATION_END => break,
                        code => factors.push((self.location_of(code, here, false)?, self.bytes.integer()?)),
                    }
                }
                match self.dump.locations.add_product(&factors) {
                    Some(number) => number,
                    None => return self.bytes.fault("a location of too many moves"),
                }
            }
            _ => return self.bytes.fault("a location of unknown kind"),
        };
        self.locations.insert(here, number as usize);
        Ok(number)
    }

    fn curve(&mut self) -> Read<Option<usize>> {
        let here = self.bytes.at();
        match self.bytes.kind()? {
            NO_CURVE => Ok(None),
            CURVE => {
                let curve = space_curve(&mut self.bytes, 0)?;
                Ok(Some(add(curve, here, &mut self.dump.curves, &mut self.curves)))
            }
            code if BACK.contains(&code) => Ok(Some(self.known(code, here, |s| &s.curves)?)),
            _ => self.bytes.fault("no curve where one is due"),
        }
    }

    fn curve2(&mut self) -> Read<Option<usize>> {
        let here = self.bytes.at();
        match self.bytes.kind()? {
            NO_CURVE2 => Ok(None),
            CURVE2 => {
                let curve: Option<Curve> = plane_curve(&mut self.bytes, 0)?;
                Ok(Some(add(curve, here, &mut self.dump.curves2, &mut self.curves2)))
            }
            code if BACK.contains(&code) => Ok(Some(self.known(code, here, |s| &s.curves2)?)),
            _ => self.bytes.fault("no curve where one is due"),
        }
    }

    fn surface(&mut self) -> Read<Option<usize>> {
        let here = self.bytes.at();
        match self.bytes.kind()? {
            NO_SURFACE => Ok(None),
            SURFACE => {
                let surface: Option<SurfaceRecord> = surface(&mut self.bytes, 0)?;
                Ok(Some(add(surface, here, &mut self.dump.surfaces, &mut self.surfaces)))
            }
            code if BACK.contains(&code) => Ok(Some(self.known(code, here, |s| &s.surfaces)?)),
            _ => self.bytes.fault("no surface where one is due"),
        }
    }

    fn due(&self, number: Option<usize>) -> Read<usize> {
        number.map_or_else(|| self.bytes.fault("a reference to nothing"), Ok)
    }

    fn vertex(&mut self) -> Read<Kind> {
        let tolerance = self.bytes.finite()?;
        let point = self.bytes.reals()?;
        // Parameters of the vertex on curves and surfaces are skipped: the edges give its place.
        loop {
            let kind = self.bytes.kind()?;
            if kind == 0 {
                return Ok(Kind::Vertex { tolerance, point });
            }
            self.bytes.real()?;
            match kind {
                1 => {
                    self.curve()?;
                }
                2 => {
                    self.curve2()?;
                    self.surface()?;
                }
                3 => {
                    self.bytes.real()?;
                    self.surface()?;
                }
                _ => return self.bytes.fault("a vertex on something unknown"),
            }
            self.location()?;
        }
    }

    fn edge(&mut self) -> Read<Kind> {
        let tolerance = self.bytes.finite()?;
        let flags = self.bytes.kind()?;
        let (same_parameter, degenerate) = (flags & 1 != 0, flags & 4 != 0);
        let (first, mut continuity) = (self.dump.on.len() as u32, 0);
        loop {
            let kind = self.bytes.kind()?;
            match kind {
                0 => {
                    let on = [first, self.dump.on.len() as u32];
                    return Ok(Kind::Edge { tolerance, same_parameter, degenerate, on, continuity });
                }
                1 => {
                    let curve = self.curve()?;
                    let location = self.location()?;
                    let range = [self.bytes.real()?, self.bytes.real()?];
                    self.dump.on.extend(curve.map(|curve| On::Curve { curve, location, range }));
                }
                2 | 3 => {
                    let one = self.curve2()?;
                    let two = if kind == 3 { self.curve2()? } else { one };
                    if kind == 3 {
                        self.bytes.kind()?; // continuity
                    }
                    let surface = self.surface()?;
                    let location = self.location()?;
                    let range = [self.bytes.real()?, self.bytes.real()?];
                    let curves = [self.due(one)?, self.due(two)?];
                    let surface = self.due(surface)?;
                    self.dump.on.push(On::Surface { curves, surface, location, range });
                }
                4 => {
                    continuity = continuity.max(1 + self.bytes.kind()?.min(100));
                    for _ in 0..2 {
                        self.surface()?;
                        self.location()?;
                    }
                }
                _ => return self.bytes.unsupported("an edge of triangles"),
            }
        }
    }

    fn face(&mut self) -> Read<Kind> {
        self.bytes.flag()?;
        let tolerance = self.bytes.finite()?;
        let surface = self.surface()?;
        let location = self.location()?;
        match self.bytes.kind()? {
            0 | 1 => Ok(Kind::Face { tolerance, surface, location, triangulation: None }),
            _ => self.bytes.unsupported("a face of triangles"),
        }
    }
}

/// Adds an item that begins at `here`; its number.
fn add<T>(item: T, here: usize, all: &mut Vec<T>, places: &mut Places) -> usize {
    all.push(item);
    places.insert(here, all.len() - 1);
    all.len() - 1
}
