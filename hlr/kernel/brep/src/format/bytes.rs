//! A binary dump (BinTools): little-endian numbers; each read checks that the bytes are there.
//!
//! The files of FreeCAD's documents are such dumps, but they name the root in another way: its number counted from the
//! first shape, its location and its orientation, four bytes each. No other root is as long.

use super::orientation::Orientation;
use super::tokens::{Damaged, FLAGS, Read, Table, Tokens};

/// How much the square of a direction's length may differ from 1: OpenCASCADE writes unit vectors. With another length, a
/// surface would be as flat as no mesher can follow.
const LENGTHENED: f64 = 1e-6;

pub struct Bytes<'a> {
    all: &'a [u8],
    at: usize,
    /// A curve on a surface is followed by the (u, v) of its ends.
    ends_in_uv: bool,
    /// A triangulation says whether it has normals.
    normals: bool,
    /// How many shapes there are.
    shapes: i32,
    /// Number and location of a root as FreeCAD names it: counted from the last shape, as those of other roots.
    freecad_root: Option<[i32; 2]>,
}

impl<'a> Bytes<'a> {
    /// # Errors
    /// The bytes do not begin as a dump in a layout that is known here.
    pub fn new(all: &'a [u8]) -> Read<Bytes<'a>> {
        let mut bytes = Bytes { all, at: 0, ends_in_uv: true, normals: false, shapes: 0, freecad_root: None };
        let mut version = bytes.line()?;
        if version.is_empty() {
            version = bytes.line()?;
        }
        match version.strip_prefix(b"Open CASCADE Topology V").and_then(<[u8]>::first) {
            Some(b'2' | b'3') => Ok(bytes),
            Some(b'4') => Ok(Bytes { ends_in_uv: false, normals: true, ..bytes }),
            _ => bytes.unsupported("not a dump in a layout that is known here"),
        }
    }

    /// Bytes of the newest layout from anywhere within a dump.
    pub fn without_header(all: &'a [u8]) -> Bytes<'a> {
        Bytes { all, at: 0, ends_in_uv: false, normals: true, shapes: 0, freecad_root: None }
    }

    /// A number of 1, 2, 4 or 8 bytes.
    pub fn unsigned(&mut self, size: usize) -> Read<u64> {
        let mut value = 0;
        for k in 0..size {
            value |= u64::from(self.kind()?) << (8 * k);
        }
        Ok(value)
    }

    fn take<const N: usize>(&mut self) -> Read<[u8; N]> {
        match self.all[self.at..].first_chunk::<N>() {
            Some(chunk) => {
                self.at += N;
                Ok(*chunk)
            }
            None => self.fault("the dump ends too early"),
        }
    }

    fn skip(&mut self, count: usize) -> Read<()> {
        if count > self.all.len() - self.at {
            return self.fault("the dump ends too early");
        }
        self.at += count;
        Ok(())
    }

    /// The bytes up to the end of the line. The reading position moves behind it.
    fn line(&mut self) -> Read<&'a [u8]> {
        let rest = &self.all[self.at..];
        match rest.iter().take(LONGEST_LINE).position(|&b| b == b'\n') {
            Some(length) => {
                self.at += length + 1;
                Ok(&rest[..length])
            }
            None => self.fault("a line without an end"),
        }
    }
}

impl Tokens for Bytes<'_> {
    fn at(&self) -> usize {
        self.at
    }

    fn holds(&self, count: usize, size: usize) -> bool {
        count <= (self.all.len() - self.at) / size
    }

    fn header(&mut self, table: Table, size: usize) -> Read<usize> {
        if table == Table::Shapes {
            self.line()?;
        }
        let line = self.line()?;
        let number = line.strip_prefix(table.name().as_bytes()).and_then(|rest| rest.strip_prefix(b" "));
        let number = number.and_then(|digits| str::from_utf8(digits).ok()).and_then(|digits| digits.parse().ok());
        match number {
            Some(count) => {
                self.shapes = count;
                self.fitting(count, size)
            }
            None => Err(Damaged { what: table.name(), at: self.at, unsupported: false }),
        }
    }

    fn kind(&mut self) -> Read<u8> {
        Ok(self.take::<1>()?[0])
    }

    fn flag(&mut self) -> Read<bool> {
        match self.kind()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => self.fault("a flag that is neither 0 nor 1"),
        }
    }

    fn short(&mut self) -> Read<usize> {
        Ok(usize::from(u16::from_le_bytes(self.take()?)))
    }

    fn integer(&mut self) -> Read<i32> {
        Ok(i32::from_le_bytes(self.take()?))
    }

    fn real(&mut self) -> Read<f64> {
        Ok(f64::from_le_bytes(self.take()?))
    }

    fn number(&mut self, table: Table) -> Read<i32> {
        match (table, self.freecad_root) {
            (Table::Shapes, Some([number, _])) => Ok(number),
            (Table::Locations, Some([_, location])) => Ok(location),
            _ => self.integer(),
        }
    }

    fn direction<const N: usize>(&mut self) -> Read<[f64; N]> {
        let found: [f64; N] = self.reals()?;
        let square: f64 = found.iter().map(|c| c * c).sum();
        if (square - 1.0).abs() <= LENGTHENED { Ok(found) } else { self.fault("a direction whose length is not 1") }
    }

    fn axes(&mut self, _either: bool) -> Read<[[f64; 3]; 3]> {
        Ok([self.direction()?, self.direction()?, self.direction()?])
    }

    fn plane_axes(&mut self) -> Read<[[f64; 2]; 2]> {
        Ok([self.direction()?, self.direction()?])
    }

    fn placement(&mut self) -> Read<[[f64; 4]; 3]> {
        Ok([self.reals()?, self.reals()?, self.reals()?])
    }

    fn skip_polygon_on_triangles(&mut self) -> Read<()> {
        let size = self.count(4)?;
        self.skip(4 * size + 8)?;
        if self.flag()? { self.skip(8 * size) } else { Ok(()) }
    }

    fn triangulation(&mut self) -> Read<(usize, usize, bool, bool)> {
        let (nodes, triangles) = (self.count(24)?, self.count(12)?);
        let has_uv = self.flag()?;
        let has_normals = self.normals && self.flag()?;
        self.skip(8)?;
        Ok((nodes, triangles, has_uv, has_normals))
    }

    fn skip_normals(&mut self, count: usize) -> Read<()> {
        self.skip(12 * count)
    }

    fn shape(&mut self) -> Read<u8> {
        self.kind()
    }

    fn place(&mut self) -> Read<(u8, f64)> {
        match self.kind()? {
            0 => Ok((0, 0.0)),
            kind => Ok((kind, self.real()?)),
        }
    }

    fn representation(&mut self) -> Read<u8> {
        self.kind()
    }

    fn continuity(&mut self) -> Read<u8> {
        self.kind()
    }

    fn skip_ends(&mut self) -> Read<()> {
        self.skip(if self.ends_in_uv { 32 } else { 0 })
    }

    fn own_triangles(&mut self, _surface: bool) -> Read<i32> {
        match self.kind()? {
            0 | 1 => Ok(0),
            2 => self.number(Table::Triangulations),
            _ => self.fault("a face of unknown kind"),
        }
    }

    fn flags(&mut self) -> Read<[bool; FLAGS]> {
        Ok(self.take::<FLAGS>()?.map(|flag| flag != 0))
    }

    fn orientation(&mut self) -> Read<Option<Orientation>> {
        let named = if self.all.len() - self.at == FREECAD_ROOT {
            let number = self.shapes.wrapping_sub(self.integer()?).wrapping_add(1);
            self.freecad_root = Some([number, self.integer()?]);
            u8::try_from(self.integer()?).unwrap_or(u8::MAX)
        } else {
            self.kind()?
        };
        Ok(Some(match named {
            0 => Orientation::Forward,
            1 => Orientation::Reversed,
            2 => Orientation::Internal,
            3 => Orientation::External,
            b'*' => return Ok(None),
            _ => return self.fault("an orientation that there is not"),
        }))
    }
}

const LONGEST_LINE: usize = 200;

/// Bytes of a root as FreeCAD names it.
const FREECAD_ROOT: usize = 12;
