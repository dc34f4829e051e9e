//! Where outlines are sought: on which faces, and of which edges of the model a mesh edge is a chord.

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

/// Walks over mesh edges: walk w is edges[offsets[w]..offsets[w + 1]]. index: its edge of the model, -1 for none.
pub struct Walks<'a> {
    pub offsets: &'a [i32],
    pub edges: &'a [i32],
    pub index: &'a [i32],
}

impl Walks<'_> {
    /// Of each of `count` mesh edges the walk along an edge of the model of which it is a chord, -1 for none. Where
    /// several share it, any of them gives the curve of the fold.
    pub fn of_edges(&self, count: usize) -> Vec<i32> {
        let mut found = vec![-1; count];
        for (walk, at) in self.offsets.windows(2).enumerate().filter(|&(walk, _)| self.index[walk] >= 0) {
            for &edge in &self.edges[at[0] as usize..at[1] as usize] {
                found[edge as usize] = walk as i32;
            }
        }
        found
    }
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

    #[test]
    fn an_edge_is_a_chord_of_the_last_walk_along_an_edge_of_the_model() {
        let walks = Walks { offsets: &[0, 2, 3, 5], edges: &[0, 1, 2, 1, 3], index: &[7, -1, 4] };
        assert_eq!(walks.of_edges(5), [0, 2, -1, 2, -1]);
    }
}
