//! A text dump (BREP files, versions 1 to 3): numbers in decimals, in the words of OpenCASCADE's "BRep Format".
//!
//! Directions are rounded in a text. As OpenCASCADE does, they are made unit vectors again, and axes square.

use super::orientation::Orientation;
use super::square::{square_placement, unit};
use super::tokens::{FLAGS, Read, Table, Tokens};
use crate::geometry::vector::{Vector, cross, dot};

pub struct Text<'a> {
    all: &'a [u8],
    at: usize,
    version: u8,
    /// Whether to stop, asked once in `OFTEN` numbers.
    stopped: &'a dyn Fn() -> bool,
    numbers: usize,
}

const OFTEN: usize = 1 << 16;

/// The version stands on one of the first lines.
const HEAD: usize = 4096;

impl<'a> Text<'a> {
    /// # Errors
    /// The text does not begin with a known version.
    pub fn new(all: &'a [u8], stopped: &'a dyn Fn() -> bool) -> Read<Text<'a>> {
        let mut text = Text { all, at: 0, version: 0, stopped, numbers: 0 };
        for line in all[..all.len().min(HEAD)].split_inclusive(|&b| b == b'\n') {
            text.at += line.len();
            if let Some([version @ b'1'..=b'3', b',', ..]) = line.strip_prefix(b"CASCADE Topology V") {
                text.version = version - b'0';
                return Ok(text);
            }
        }
        text.unsupported("no version of BREP that is known here")
    }

    /// The characters up to the next white space; none at the end of the text.
    fn word(&mut self) -> &'a [u8] {
        self.skip_space();
        let rest = &self.all[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    /// Counts a number.
    fn go_on(&mut self) -> Read<()> {
        self.numbers += 1;
        if self.numbers.is_multiple_of(OFTEN) && (self.stopped)() { self.fault("stopped") } else { Ok(()) }
    }

    fn skip_space(&mut self) {
        let rest = &self.all[self.at..];
        self.at += rest.iter().position(|b| !b.is_ascii_whitespace()).unwrap_or(rest.len());
    }

    fn skip_reals(&mut self, count: usize) -> Read<()> {
        (0..count).try_for_each(|_| self.real().map(drop))
    }

    fn unit<const N: usize>(&self, vector: [f64; N]) -> Read<[f64; N]> {
        match unit(vector) {
            Some(vector) => Ok(vector),
            None => self.unsupported("a direction without length"),
        }
    }
}

impl Tokens for Text<'_> {
    fn at(&self) -> usize {
        self.at
    }

    /// Each number takes two characters at least: a quarter of what the longest take in a binary dump.
    fn holds(&self, count: usize, size: usize) -> bool {
        count <= (self.all.len() - self.at) / (size / 4).max(1)
    }

    fn header(&mut self, table: Table, size: usize) -> Read<usize> {
        if self.word() != table.name().as_bytes() {
            return self.fault(table.name());
        }
        let count = self.integer()?;
        self.fitting(count, 4 * size)
    }

    fn kind(&mut self) -> Read<u8> {
        match u8::try_from(self.integer()?) {
            Ok(kind) => Ok(kind),
            Err(_) => self.fault("a kind that there is not"),
        }
    }

    fn flag(&mut self) -> Read<bool> {
        match self.integer()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => self.fault("a flag that is neither 0 nor 1"),
        }
    }

    fn short(&mut self) -> Read<usize> {
        Ok(usize::try_from(self.integer()?).unwrap_or(usize::MAX))
    }

    /// Letters may follow without a space.
    fn integer(&mut self) -> Read<i32> {
        self.go_on()?;
        self.skip_space();
        let rest = &self.all[self.at..];
        let sign = usize::from(matches!(rest, [b'+' | b'-', ..]));
        let digits = rest[sign..].iter().take(MOST_DIGITS).position(|b| !b.is_ascii_digit());
        let length = sign + digits.unwrap_or(rest.len() - sign);
        let number = rest.get(..length).and_then(|word| str::from_utf8(word).ok()).and_then(|word| word.parse().ok());
        let Some(number) = number else { return self.fault("no whole number where one belongs") };
        self.at += length;
        Ok(number)
    }

    fn real(&mut self) -> Read<f64> {
        self.go_on()?;
        let word = self.word();
        match str::from_utf8(word).ok().and_then(|word| word.parse().ok()) {
            Some(value) => Ok(value),
            None if word.is_empty() => self.fault("the text ends too early"),
            None => self.fault("no number where one belongs"),
        }
    }

    fn direction<const N: usize>(&mut self) -> Read<[f64; N]> {
        let written = self.reals()?;
        self.unit(written)
    }

    fn axes(&mut self, either: bool) -> Read<[Vector; 3]> {
        let [z, written_x, written_y] = [self.direction()?, self.direction()?, self.direction::<3>()?];
        let x = self.unit(cross(&z, &cross(&written_x, &z)))?;
        let y = self.unit(cross(&z, &x))?;
        let left_handed = either && dot(&written_y, &cross(&z, &written_x)) < 0.0;
        Ok([z, x, if left_handed { y.map(|c| -c) } else { y }])
    }

    fn plane_axes(&mut self) -> Read<[[f64; 2]; 2]> {
        let ([a, b], [c, d]) = (self.direction::<2>()?, self.direction::<2>()?);
        Ok([[a, b], if a * d - b * c >= 0.0 { [-b, a] } else { [b, -a] }])
    }

    /// A rotation times a scale, which is negative for a mirror image.
    fn placement(&mut self) -> Read<[[f64; 4]; 3]> {
        let rows: [[f64; 4]; 3] = [self.reals()?, self.reals()?, self.reals()?];
        match square_placement(&rows) {
            Some(placement) => Ok(placement),
            None => self.unsupported("a placement without volume"),
        }
    }

    fn skip_polygon_on_triangles(&mut self) -> Read<()> {
        let size = self.count(4)?;
        for _ in 0..size {
            self.integer()?;
        }
        if self.word() != b"p" {
            return self.fault("a polygon without its parameters");
        }
        self.real()?;
        let parameters = self.flag()?;
        self.skip_reals(if parameters { size } else { 0 })
    }

    fn triangulation(&mut self) -> Read<(usize, usize, bool, bool)> {
        let (nodes, triangles) = (self.count(24)?, self.count(12)?);
        let has_uv = self.flag()?;
        let has_normals = self.version == 3 && self.flag()?;
        self.real()?;
        Ok((nodes, triangles, has_uv, has_normals))
    }

    fn skip_normals(&mut self, count: usize) -> Read<()> {
        self.skip_reals(3 * count)
    }

    fn shape(&mut self) -> Read<u8> {
        let word = self.word();
        match [b"Co", b"CS", b"So", b"Sh", b"Fa", b"Wi", b"Ed", b"Ve"].iter().position(|name| *name == word) {
            Some(kind) => Ok(kind as u8),
            None => self.fault("a shape of unknown kind"),
        }
    }

    fn place(&mut self) -> Read<(u8, f64)> {
        let parameter = self.real()?;
        Ok((self.kind()?, parameter))
    }

    fn representation(&mut self) -> Read<u8> {
        self.kind()
    }

    fn continuity(&mut self) -> Read<u8> {
        let word = self.word();
        match [b"C0", b"G1", b"C1", b"G2", b"C2", b"C3", b"CN"].iter().position(|name| *name == word) {
            Some(order) => Ok(order as u8),
            None => self.fault("a continuity that there is not"),
        }
    }

    fn skip_ends(&mut self) -> Read<()> {
        self.skip_reals(if self.version == 2 { 4 } else { 0 })
    }

    /// Without triangles the flags follow, which are seven digits.
    fn own_triangles(&mut self, _surface: bool) -> Read<i32> {
        let before = self.at;
        if self.word() == b"2" {
            return self.number(Table::Triangulations);
        }
        self.at = before;
        Ok(0)
    }

    fn flags(&mut self) -> Read<[bool; FLAGS]> {
        match self.word().first_chunk::<FLAGS>() {
            Some(flags) => Ok(flags.map(|flag| flag == b'1')),
            None => self.fault("a shape without its flags"),
        }
    }

    fn orientation(&mut self) -> Read<Option<Orientation>> {
        self.skip_space();
        let sign = self.all.get(self.at).copied();
        self.at += usize::from(sign.is_some());
        Ok(Some(match sign {
            Some(b'+') => Orientation::Forward,
            Some(b'-') => Orientation::Reversed,
            Some(b'i') => Orientation::Internal,
            Some(b'e') => Orientation::External,
            Some(b'*') => return Ok(None),
            _ => return self.fault("an orientation that there is not"),
        }))
    }
}

/// More digits than a number that a reference or a count may have.
const MOST_DIGITS: usize = 12;
