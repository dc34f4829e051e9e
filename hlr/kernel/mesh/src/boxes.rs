//! Bounding boxes of placed parts.

type Vec3 = [f64; 3];

/// The eight corners of each part's box, and the lower and upper corner of the box around all of them.
///
/// `boxes`: lower, then upper corner; `root`: the box of each part; `place`: the placement of each part, a matrix by
/// rows. A box whose lower corner lies beyond its upper one is void: its corners are 0, and do not count.
pub fn placed(boxes: &[[f64; 6]], root: &[i32], place: &[[f64; 16]]) -> (Vec<Vec3>, [Vec3; 2]) {
    let mut corners = vec![[0.0; 3]; 8 * root.len()];
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for ((own, &root), m) in corners.chunks_exact_mut(8).zip(root).zip(place) {
        let b = &boxes[root as usize];
        if b[0] > b[3] {
            continue;
        }
        for (k, corner) in own.iter_mut().enumerate() {
            let [x, y, z] = [b[3 * (k >> 2)], b[3 * (k >> 1 & 1) + 1], b[3 * (k & 1) + 2]];
            for i in 0..3 {
                let c = m[4 * i] * x + m[4 * i + 1] * y + m[4 * i + 2] * z + m[4 * i + 3];
                corner[i] = c;
                // NaN is kept: the caller refuses it.
                low[i] = if c < low[i] || c.is_nan() { c } else { low[i] };
                high[i] = if c > high[i] || c.is_nan() { c } else { high[i] };
            }
        }
    }
    (corners, [low, high])
}
