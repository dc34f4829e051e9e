//! Reads STL, binary and text: separate triangles, whose corners are not joined yet.

use super::polygon::Faces;
use super::text::{Lines, coordinates, first_word, plain, words};
use super::{Fault, MOST_POINTS, MeshFile, Piece, Stop, polled};

const HEADER: usize = 84;
const RECORD: usize = 50;

/// Number of triangles that a binary file announces, if it has room for them; more bytes may follow.
fn announced(data: &[u8]) -> Option<usize> {
    let count = u32::from_le_bytes(data.get(80..HEADER)?.try_into().ok()?) as usize;
    (data.len() - HEADER >= count.checked_mul(RECORD)?).then_some(count).filter(|&count| count > 0)
}

pub fn read(data: &[u8], stop: Stop) -> Result<MeshFile, Fault> {
    match announced(data) {
        Some(count) => binary(&data[HEADER..HEADER + RECORD * count], stop),
        None => text(data, stop),
    }
}

fn binary(records: &[u8], stop: Stop) -> Result<MeshFile, Fault> {
    let count = records.len() / RECORD;
    if 3 * count > MOST_POINTS {
        return Err(Fault::Broken("it has too many triangles".into()));
    }
    let mut points = Vec::with_capacity(3 * count);
    for (k, record) in records.chunks_exact(RECORD).enumerate() {
        polled(k, stop)?;
        let single = |at: usize| f64::from(f32::from_le_bytes([0, 1, 2, 3].map(|i| record[at + i])));
        points.extend([12, 24, 36].map(|at| [single(at), single(at + 4), single(at + 8)]));
    }
    let triangles = (0..count as i32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let piece = Piece { name: String::new(), triangles };
    Ok(MeshFile { points, pieces: vec![piece], ..MeshFile::default() })
}

/// Reads text. Each `solid` is a piece; a word that the format does not know is skipped with its line.
fn text(data: &[u8], stop: Stop) -> Result<MeshFile, Fault> {
    let mut points: Vec<[f64; 3]> = Vec::new();
    let mut solids: Vec<(String, Faces)> = Vec::new();
    let mut open = false;
    let mut corners: Vec<i64> = Vec::new();
    let mut lines = Lines::new(data);
    while let Some(mut line) = lines.next_line() {
        polled(lines.number, stop)?;
        let broken = |what: &str| Fault::Broken(format!("line {} {what}", lines.number));
        loop {
            let (word, rest) = first_word(line);
            let is = |name: &str| word.eq_ignore_ascii_case(name.as_bytes());
            line = rest;
            if is("vertex") {
                corners.push(points.len() as i64);
                points.push(coordinates(words(rest)).map_err(|e| broken(&e))?);
                // Goes on with the rest of the line: a whole facet may stand on one line.
                (0..3).for_each(|_| line = first_word(line).1);
            } else if is("endloop") || is("endfacet") {
                let solid =
                    solids.last_mut().filter(|_| open).ok_or_else(|| broken("ends a facet outside of a solid"))?;
                if !corners.is_empty() && !solid.1.push(&corners) {
                    return Err(broken("ends a facet of fewer than three corners"));
                }
                corners.clear();
            } else if is("solid") {
                solids.push((plain(rest), Faces::default()));
                open = true;
                break;
            } else if is("endsolid") {
                open = false;
                break;
            } else if is("normal") {
                (0..3).for_each(|_| line = first_word(line).1);
            } else if !(is("facet") || is("outer") || is("loop")) {
                break;
            }
        }
    }
    let mut pieces = Vec::with_capacity(solids.len());
    for (name, faces) in solids {
        pieces.push(Piece { name, triangles: faces.triangles(&points, stop)?.0 });
    }
    pieces.retain(|piece| !piece.triangles.is_empty());
    Ok(MeshFile { points, pieces, ..MeshFile::default() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(data: &[u8]) -> Result<MeshFile, Fault> {
        super::read(data, &|| false)
    }

    fn record() -> Vec<u8> {
        let numbers = [0.0, 0.0, 1.0, 0.0, 0.0, 0.5, 1.0, 0.0, 0.5, 0.0, 1.0, 0.5f32];
        numbers.iter().flat_map(|v| v.to_le_bytes()).chain([7, 7]).collect()
    }

    #[test]
    fn binary_also_with_bytes_after_it_and_a_header_like_a_text() {
        let mut data = b"solid of a careless program".to_vec();
        data.resize(80, b' ');
        data.extend(2u32.to_le_bytes());
        data.extend([record(), record()].concat());
        data.extend(b"more");
        let found = read(&data).unwrap();
        assert_eq!(found.points[..3], [[0.0, 0.0, 0.5], [1.0, 0.0, 0.5], [0.0, 1.0, 0.5]]);
        assert_eq!(found.pieces[0].triangles, [[0, 1, 2], [3, 4, 5]]);
    }

    #[test]
    fn text_in_any_layout() {
        let solid = |name: &str| {
            format!(
                "Solid {name}\nFACET normal 0 0 1\n outer loop\nvertex 0 0 0\r\nvertex 1 0 0 vertex 0 1e0 0\nendloop endfacet\nendsolid {name}\n"
            )
        };
        let both = format!("{}\n{}", solid("one of two"), solid(""));
        let found = read(both.as_bytes()).unwrap();
        assert_eq!(found.pieces.iter().map(|p| p.name.as_str()).collect::<Vec<_>>(), ["one of two", ""]);
        assert_eq!((found.points.len(), &found.pieces[1].triangles), (6, &vec![[3, 4, 5]]));
    }

    #[test]
    fn broken_texts_say_where() {
        let line = |text: &str| match read(text.as_bytes()) {
            Err(Fault::Broken(what)) => what,
            other => panic!("{other:?}"),
        };
        assert_eq!(line("solid\nvertex a 0 0\n"), "line 2 has \"a\" for a coordinate");
        assert_eq!(line("solid\nvertex 0 0 0\nendloop\n"), "line 3 ends a facet of fewer than three corners");
        assert_eq!(line("endloop\n"), "line 1 ends a facet outside of a solid");
        assert_eq!(read(b"solid x\nendsolid x\n").unwrap().pieces, []);
    }
}
