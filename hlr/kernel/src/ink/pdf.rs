//! Path painting commands of PDF, one painted path per stroke: a single path for a whole layer is slow in viewers.

use super::digits::put;
use super::{CONTROL, CUBIC, START, Strokes};

/// All strokes, and where each begins (strokes + 1); arcs and quadratic curves must have become cubic ones before.
pub fn paths(strokes: &Strokes) -> (Vec<u8>, Vec<i64>) {
    let mut out = Vec::new();
    let mut offsets = vec![0];
    for (w, &closed) in strokes.starts.windows(2).zip(strokes.closed) {
        for i in w[0] as usize..w[1] as usize {
            if i as i64 > w[0] {
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
        offsets.push(out.len() as i64);
    }
    (out, offsets)
}
