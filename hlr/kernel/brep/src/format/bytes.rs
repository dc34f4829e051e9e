//! Reads little-endian numbers from the bytes of a dump; each read checks that the bytes are there.

/// What is wrong with the bytes, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Damaged {
    pub what: &'static str,
    pub at: usize,
}

impl std::fmt::Display for Damaged {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} (at byte {})", self.what, self.at)
    }
}

pub type Read<T> = Result<T, Damaged>;

pub struct Bytes<'a> {
    all: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    pub fn new(all: &'a [u8]) -> Bytes<'a> {
        Bytes { all, at: 0 }
    }

    pub fn left(&self) -> usize {
        self.all.len() - self.at
    }

    pub fn fault<T>(&self, what: &'static str) -> Read<T> {
        Err(Damaged { what, at: self.at })
    }

    pub fn take<const N: usize>(&mut self) -> Read<[u8; N]> {
        match self.all[self.at..].first_chunk::<N>() {
            Some(chunk) => {
                self.at += N;
                Ok(*chunk)
            }
            None => self.fault("the dump ends too early"),
        }
    }

    pub fn skip(&mut self, count: usize) -> Read<()> {
        if count > self.left() {
            return self.fault("the dump ends too early");
        }
        self.at += count;
        Ok(())
    }

    pub fn byte(&mut self) -> Read<u8> {
        Ok(self.take::<1>()?[0])
    }

    pub fn flag(&mut self) -> Read<bool> {
        match self.byte()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => self.fault("a flag that is neither 0 nor 1"),
        }
    }

    pub fn short(&mut self) -> Read<usize> {
        Ok(usize::from(u16::from_le_bytes(self.take()?)))
    }

    pub fn integer(&mut self) -> Read<i32> {
        Ok(i32::from_le_bytes(self.take()?))
    }

    pub fn real(&mut self) -> Read<f64> {
        Ok(f64::from_le_bytes(self.take()?))
    }

    pub fn finite(&mut self) -> Read<f64> {
        let value = self.real()?;
        if value.is_finite() { Ok(value) } else { self.fault("a number that is not finite") }
    }

    pub fn reals<const N: usize>(&mut self) -> Read<[f64; N]> {
        let mut out = [0.0; N];
        for value in &mut out {
            *value = self.finite()?;
        }
        Ok(out)
    }

    /// Reads a count of items of at least `size` bytes each. It may not exceed what the remaining bytes can hold.
    pub fn count(&mut self, size: usize) -> Read<usize> {
        let count = self.integer()?;
        self.fitting(count, size)
    }

    pub fn fitting(&self, count: i32, size: usize) -> Read<usize> {
        match usize::try_from(count) {
            Ok(count) if count <= self.left() / size => Ok(count),
            _ => self.fault("a count that the bytes cannot hold"),
        }
    }

    /// Reads a number from 1 to `most`, and returns it counted from 0.
    pub fn index(&mut self, most: usize) -> Read<usize> {
        match usize::try_from(self.integer()?) {
            Ok(number) if (1..=most).contains(&number) => Ok(number - 1),
            _ => self.fault("a reference to nothing"),
        }
    }

    /// Reads a number that counts from 1 and returns it counted from 0; None for 0.
    pub fn maybe_index(&mut self, most: usize) -> Read<Option<usize>> {
        match usize::try_from(self.integer()?) {
            Ok(0) => Ok(None),
            Ok(number) if number <= most => Ok(Some(number - 1)),
            _ => self.fault("a reference to nothing"),
        }
    }

    /// The bytes up to the end of the line. The reading position moves behind it.
    pub fn line(&mut self) -> Read<&'a [u8]> {
        let rest = &self.all[self.at..];
        match rest.iter().take(LONGEST_LINE).position(|&b| b == b'\n') {
            Some(length) => {
                self.at += length + 1;
                Ok(&rest[..length])
            }
            None => self.fault("a line without an end"),
        }
    }

    /// The header of a section: its name and a count. Each item has at least `size` bytes.
    pub fn header(&mut self, name: &'static str, size: usize) -> Read<usize> {
        let line = self.line()?;
        let number = line.strip_prefix(name.as_bytes()).and_then(|rest| rest.strip_prefix(b" "));
        let number = number.and_then(|digits| str::from_utf8(digits).ok()).and_then(|digits| digits.parse().ok());
        match number {
            Some(count) => self.fitting(count, size),
            None => Err(Damaged { what: name, at: self.at }),
        }
    }
}

const LONGEST_LINE: usize = 200;
