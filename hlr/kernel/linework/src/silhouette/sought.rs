//! On which faces outlines are sought.

/// Faces that are traced: curved ones, and planar ones that a curved one joins smoothly, for the curved one may fold
/// over against them. curved: of each face; face: of each triangle; offsets, incident: the triangles at each edge;
/// tangent: two faces join smoothly at an edge with this number.
pub fn traced_faces(
    curved: &[bool],
    face: &[i32],
    offsets: &[i32],
    incident: &[i32],
    tangent: impl Fn(usize) -> bool,
) -> Vec<bool> {
    let mut traced = curved.to_vec();
    for (edge, at) in offsets.windows(2).enumerate() {
        if at[1] - at[0] != 2 || !tangent(edge) {
            continue;
        }
        let [one, two] = [0, 1].map(|k| face[incident[at[0] as usize + k] as usize] as usize);
        traced[one] |= curved[two];
        traced[two] |= curved[one];
    }
    traced
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planar_faces_are_traced_where_a_curved_one_joins_them_smoothly() {
        // Edge 0 lies between the triangles of faces 0 and 1, edge 1 between those of 1 and 2, edge 2 bounds face 2.
        let (offsets, incident) = ([0, 2, 4, 5], [0, 1, 1, 2, 2]);
        let traced = |curved: [bool; 3], tangent: [bool; 3]| {
            traced_faces(&curved, &[0, 1, 2], &offsets, &incident, |edge| tangent[edge])
        };
        assert_eq!(traced([true, false, false], [true; 3]), [true, true, false]);
        assert_eq!(traced([true, false, false], [false, true, true]), [true, false, false]);
        assert_eq!(traced([false, false, true], [true; 3]), [false, true, true]);
    }
}
