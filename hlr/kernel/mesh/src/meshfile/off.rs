//! Reads OFF: counts, then a row of coordinates per vertex and a row of corners per face.

use super::polygon::Faces;
use super::text::{Lines, coordinates, shown, whole, words};
use super::{Fault, MeshFile, Piece, Stop, counted, polled};

pub fn read(data: &[u8], stop: Stop) -> Result<MeshFile, Fault> {
    let mut lines = Lines::new(data);
    let head = lines.next_row().unwrap_or_default();
    // The counts may follow the format's name on its line.
    let behind = words(head).nth(1).is_some();
    let counts = if behind { head } else { lines.next_row().unwrap_or_default() };
    let mut row = words(counts).skip(usize::from(behind));
    let mut count = || row.next().and_then(whole).and_then(|n| usize::try_from(n).ok());
    let (Some(vertices), Some(faces)) = (count(), count()) else {
        return Err(Fault::Broken(format!(
            "line {} holds no numbers of vertices and faces: {}",
            lines.number,
            shown(counts)
        )));
    };
    // A row takes at least two bytes, so a number of rows that cannot fit is refused before anything is read.
    let rows = vertices.saturating_add(faces);
    let have = |done: usize| {
        Fault::Cut(format!("its header announces {} of numbers, the file has {done}", counted(rows, "row")))
    };
    if rows > data.len() {
        return Err(Fault::Cut("its header announces more than the file holds".into()));
    }
    let mut points = Vec::new();
    for k in 0..vertices {
        polled(k, stop)?;
        let row = lines.next_row().ok_or_else(|| have(k))?;
        points.push(coordinates(words(row)).map_err(|what| Fault::Broken(format!("line {} {what}", lines.number)))?);
    }
    let (mut polygons, mut face) = (Faces::default(), Vec::new());
    for k in 0..faces {
        polled(k, stop)?;
        let row = lines.next_row().ok_or_else(|| have(vertices + k))?;
        let broken = |what: String| Fault::Broken(format!("line {} {what}", lines.number));
        let mut numbers = words(row);
        let first = numbers.next().unwrap_or_default();
        let size = whole(first)
            .filter(|&n| n >= 0)
            .ok_or_else(|| broken(format!("has {} for a number of corners", shown(first))))?;
        face.clear();
        for word in numbers.take(usize::try_from(size).unwrap_or(usize::MAX)) {
            let corner = whole(word).ok_or_else(|| broken(format!("has {} for a vertex", shown(word))))?;
            if corner < 0 || corner >= points.len() as i64 {
                return Err(broken(format!("names vertex {corner}, and there are {vertices}, counted from 0")));
            }
            face.push(corner);
        }
        if (face.len() as i64) < size {
            return Err(match k + 1 == faces {
                true => Fault::Cut("its last row is not whole".into()),
                false => broken(format!("has {} instead of {size}", counted(face.len(), "corner"))),
            });
        }
        polygons.push(&face);
    }
    let triangles = polygons.triangles(&points, stop)?.0;
    Ok(MeshFile { points, pieces: vec![Piece { name: String::new(), triangles }], ..MeshFile::default() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(data: &str) -> Result<MeshFile, Fault> {
        super::read(data.as_bytes(), &|| false)
    }

    #[test]
    fn colours_and_comments_are_passed_over() {
        let found = read(
            "# from x\nCOFF\n\n4 2 0 # counts\n0 0 0 255 0 0 255\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 0.5 0.5\n2 0 1\n",
        )
        .unwrap();
        assert_eq!(found.pieces[0].triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(read("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2").unwrap().points.len(), 3);
    }

    #[test]
    fn what_is_missing_is_said() {
        let cut = |text: &str| match read(text) {
            Err(Fault::Cut(what)) => what,
            other => panic!("{other:?}"),
        };
        assert_eq!(cut("OFF\n3 1 0\n0 0 0\n1 0 0\n"), "its header announces 4 rows of numbers, the file has 2");
        assert_eq!(cut("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"), "its last row is not whole");
        assert_eq!(cut("OFF\n2000000000 1 0\n"), "its header announces more than the file holds");
        assert_eq!(
            cut("OFF\n9223372036854775807 9223372036854775807 0\n"),
            "its header announces more than the file holds"
        );
    }

    #[test]
    fn what_is_wrong_is_said() {
        let broken = |text: &str| match read(&format!("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n{text}\n3 0 1 2\n")) {
            Err(Fault::Broken(what)) => what,
            other => panic!("{other:?}"),
        };
        assert_eq!(broken("3 0 1"), "line 6 has 2 corners instead of 3");
        assert_eq!(broken("3 0 1 3"), "line 6 names vertex 3, and there are 3, counted from 0");
        assert_eq!(broken("3 0 1 x"), "line 6 has \"x\" for a vertex");
        assert_eq!(broken("-3 0 1 2"), "line 6 has \"-3\" for a number of corners");
        assert_eq!(
            read("OFF\n-3 -1 0\n"),
            Err(Fault::Broken("line 2 holds no numbers of vertices and faces: \"-3 -1 0\"".into()))
        );
        assert_eq!(read("OFF\n"), Err(Fault::Broken("line 1 holds no numbers of vertices and faces: \"\"".into())));
    }
}
