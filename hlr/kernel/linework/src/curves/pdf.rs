//! Writes strokes as path painting commands of PDF, one path per stroke: one path for a whole layer is slow in viewers.

use super::dashes::Fitted;
use super::digits::put;
use super::layer::Layer;
use super::strokes::{CONTROL, CUBIC, START};

/// Paths of all strokes. Arcs and quadratic curves must be cubic ones already. dashes: one per stroke, or empty.
pub fn painted(layer: &Layer, dashes: &[Fitted]) -> Vec<u8> {
    let strokes = layer.strokes();
    let mut out = Vec::new();
    let mut last = (String::new(), String::new());
    for (s, &closed) in strokes.closed.iter().enumerate() {
        if let Some(pattern) = dashes.get(s).map(Fitted::text) {
            if pattern != last {
                let begin = if pattern.1.is_empty() { "0" } else { &pattern.1 };
                out.extend(format!("[{}] {begin} d\n", pattern.0).as_bytes());
            }
            last = pattern;
        }
        let first = strokes.starts[s] as usize;
        for i in first..strokes.starts[s + 1] as usize {
            if i > first {
                out.push(b' ');
            }
            let [x, y] = strokes.points[i];
            put(&mut out, x, strokes.places);
            out.push(b' ');
            put(&mut out, y, strokes.places);
            out.extend(match strokes.op[i] {
                START => &b" m"[..],
                CONTROL => b"",
                CUBIC => b" c",
                _ => b" l",
            });
        }
        out.extend(if closed { b" s\n" } else { b" S\n" });
    }
    out
}
