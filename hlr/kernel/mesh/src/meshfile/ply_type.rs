//! The types of numbers that a PLY header names.

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Type {
    Signed(usize),
    Unsigned(usize),
    Float(usize),
}

impl Type {
    pub fn named(name: &[u8]) -> Option<Type> {
        Some(match name {
            b"char" | b"int8" => Type::Signed(1),
            b"uchar" | b"uint8" => Type::Unsigned(1),
            b"short" | b"int16" => Type::Signed(2),
            b"ushort" | b"uint16" => Type::Unsigned(2),
            b"int" | b"int32" => Type::Signed(4),
            b"uint" | b"uint32" => Type::Unsigned(4),
            b"int64" => Type::Signed(8),
            b"uint64" => Type::Unsigned(8),
            b"float" | b"float32" => Type::Float(4),
            b"double" | b"float64" => Type::Float(8),
            _ => return None,
        })
    }

    pub fn size(self) -> usize {
        let (Type::Signed(size) | Type::Unsigned(size) | Type::Float(size)) = self;
        size
    }

    pub fn decoded(self, bytes: &[u8], little: bool) -> f64 {
        let mut eight = [0; 8];
        let n = bytes.len();
        eight[..n].copy_from_slice(bytes);
        if !little {
            eight[..n].reverse();
        }
        let all = u64::from_le_bytes(eight);
        match self {
            Type::Unsigned(_) => all as f64,
            Type::Signed(size) => {
                let unused = 64 - 8 * size as u32;
                ((all << unused) as i64 >> unused) as f64
            }
            Type::Float(4) => f64::from(f32::from_bits(all as u32)),
            Type::Float(_) => f64::from_bits(all),
        }
    }

    /// Rounds a number read from text to this type.
    pub fn rounded(self, value: f64) -> f64 {
        if self == Type::Float(4) { f64::from(value as f32) } else { value }
    }

    /// Scales a colour to 0..255.
    pub fn shade(self, value: f64) -> u8 {
        let shade = match self {
            Type::Float(4) => f64::from(value as f32 * 255.0),
            Type::Float(_) => value * 255.0,
            Type::Unsigned(2) => value / 257.0,
            _ => value,
        };
        // NaN becomes 0.
        shade.round_ties_even().clamp(0.0, 255.0) as u8
    }
}
