//! Draws values from the bytes of a fuzzer; after the end of the bytes it draws zeros.

pub struct Bytes<'a> {
    left: &'a [u8],
}

/// How numbers are made: the smaller the choice, the more coincidences.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// 0, 1, 2, 3
    Few,
    Small,
    Wide,
    /// Small ones times two to any power.
    Scaled,
    /// Any bits that are finite.
    Any,
}

impl<'a> Bytes<'a> {
    pub fn new(data: &'a [u8]) -> Self {
        Bytes { left: data }
    }

    fn take<const N: usize>(&mut self) -> [u8; N] {
        let mut out = [0; N];
        let n = N.min(self.left.len());
        out[..n].copy_from_slice(&self.left[..n]);
        self.left = &self.left[n..];
        out
    }

    pub fn byte(&mut self) -> u8 {
        self.take::<1>()[0]
    }

    pub fn bit(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// 0..n, n > 0
    pub fn below(&mut self, n: usize) -> usize {
        if n <= 256 { usize::from(self.byte()) % n } else { usize::from(u16::from_le_bytes(self.take())) % n }
    }

    pub fn numbers(&mut self) -> Numbers {
        [Numbers::Few, Numbers::Small, Numbers::Wide, Numbers::Scaled, Numbers::Any][self.below(5)]
    }

    /// A finite number.
    pub fn number(&mut self, kind: Numbers) -> f64 {
        match kind {
            Numbers::Few => f64::from(self.byte() % 4),
            Numbers::Small => f64::from(i8::from_le_bytes(self.take())),
            Numbers::Wide => f64::from(i32::from_le_bytes(self.take())),
            Numbers::Scaled => f64::from(i8::from_le_bytes(self.take())) * 2f64.powi(i32::from(self.byte()) - 128),
            Numbers::Any => {
                let x = f64::from_le_bytes(self.take());
                if x.is_finite() { x } else { 1.0 }
            }
        }
    }

    /// 0..1 inclusive, often at the ends or alike.
    pub fn fraction(&mut self) -> f64 {
        f64::from(self.byte() % 17) / 16.0
    }
}
