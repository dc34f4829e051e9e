//! Converts linear light to sRGB (IEC 61966-2-1), and back.

use hlr_exact::elementary::power;
use std::sync::OnceLock;

/// Number of steps of linear light in the table: fine enough that each of the 256 sRGB values is reached.
const STEPS: usize = 1 << 13;

pub struct Encoder {
    table: &'static [u8],
}

impl Encoder {
    pub fn new() -> Encoder {
        static TABLE: OnceLock<Vec<u8>> = OnceLock::new();
        let fill = || (0..=STEPS).map(|i| (encoded(i as f64 / STEPS as f64) * 255.0).round() as u8).collect();
        Encoder { table: TABLE.get_or_init(fill) }
    }

    #[inline(always)]
    fn channel(&self, linear: f32) -> u8 {
        let step = (linear * STEPS as f32 + 0.5) as i32;
        self.table[step.clamp(0, STEPS as i32) as usize]
    }

    #[inline(always)]
    pub fn opaque(&self, c: [f32; 3]) -> [u8; 4] {
        [self.channel(c[0]), self.channel(c[1]), self.channel(c[2]), 255]
    }

    /// From linear light, premultiplied by opacity, to sRGB with straight opacity.
    #[inline(always)]
    pub fn pixel(&self, c: [f32; 4]) -> [u8; 4] {
        if c[3] >= 1.0 {
            return self.opaque([c[0], c[1], c[2]]);
        }
        if c[3] <= 0.0 {
            return [0; 4];
        }
        let [r, g, b] = [c[0], c[1], c[2]].map(|v| self.channel(v / c[3]));
        [r, g, b, (c[3] * 255.0 + 0.5) as u8]
    }
}

impl Default for Encoder {
    fn default() -> Encoder {
        Encoder::new()
    }
}

fn encoded(linear: f64) -> f64 {
    if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * power(linear, 1.0 / 2.4) - 0.055 }
}
