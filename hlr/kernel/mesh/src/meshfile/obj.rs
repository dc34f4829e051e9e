//! Reads OBJ: vertices, faces, and their objects or groups. Materials are in other files, which are not read.

use std::collections::HashMap;

use super::polygon::Faces;
use super::text::{Lines, coordinates, first_word, number, plain, shown, whole, words};
use super::{Fault, MOST_POINTS, MeshFile, Paint, Piece, Stop, polled};

/// The name of all faces from face `first` on, until the next run.
struct Run {
    first: usize,
    object: usize,
    group: usize,
}

pub fn read(data: &[u8], stop: Stop) -> Result<MeshFile, Fault> {
    let data = data.strip_prefix(b"\xef\xbb\xbf").unwrap_or(data);
    let mut points: Vec<[f64; 3]> = Vec::new();
    let mut colors: Option<Vec<[u8; 4]>> = Some(Vec::new());
    let (mut faces, mut face, mut farthest) = (Faces::default(), Vec::new(), (0, 0));
    let mut names = Names::default();
    let mut runs = vec![Run { first: 0, object: 0, group: 0 }];
    let mut lines = Lines::new(data);
    while let Some(line) = lines.next_joined() {
        polled(lines.number, stop)?;
        let broken = |what: String| Fault::Broken(format!("line {} {what}", lines.number));
        let (word, rest) = first_word(&line);
        match word {
            b"v" => {
                if points.len() >= MOST_POINTS {
                    return Err(broken("is one vertex too many".into()));
                }
                let row = words(rest).take_while(|w| w[0] != b'#');
                points.push(coordinates(row.clone()).map_err(broken)?);
                colors = colors.and_then(|mut all| {
                    all.push(color(row.skip(3))?);
                    Some(all)
                });
            }
            b"f" => {
                face.clear();
                for word in words(rest).take_while(|w| w[0] != b'#') {
                    let corner = word.split(|&b| b == b'/').next().unwrap_or_default();
                    let index = match whole(corner) {
                        Some(k @ 1..) => k - 1,
                        // A negative number counts back from the vertex read last.
                        Some(k @ ..=-1) if points.len() as i64 + k >= 0 => points.len() as i64 + k,
                        Some(k) => return Err(broken(missing(k, points.len()))),
                        None => return Err(broken(format!("has {} for a vertex", shown(corner)))),
                    };
                    if index >= farthest.0 {
                        farthest = (index + 1, lines.number);
                    }
                    face.push(index);
                }
                faces.push(&face);
            }
            b"o" | b"g" => {
                let Run { object, group, .. } = runs[runs.len() - 1];
                let name = names.number(rest);
                let (object, group) = if word == b"o" { (name, group) } else { (object, name) };
                runs.push(Run { first: faces.len(), object, group });
            }
            _ => {}
        }
    }
    if farthest.0 > points.len() as i64 {
        return Err(Fault::Broken(format!("line {} {}", farthest.1, missing(farthest.0, points.len()))));
    }
    let (triangles, face) = faces.triangles(&points, stop)?;
    let pieces = pieces(triangles, face.as_deref(), &runs, names, points.len());
    let paint = colors.filter(|all| !all.is_empty()).map_or(Paint::None, Paint::Points);
    Ok(MeshFile { points, pieces, paint })
}

/// Divides faces by objects, else by groups. Groups that share vertices are regions of one surface, and no parts.
fn pieces(triangles: Vec<[i32; 3]>, face: Option<&[u32]>, runs: &[Run], names: Names, points: usize) -> Vec<Piece> {
    let face_of = |t: usize| face.map_or(t, |face| face[t] as usize);
    let run_of: Vec<u32> = {
        let mut run = 0;
        let next = |run: usize, face: usize| runs.get(run + 1).is_some_and(|r| r.first <= face);
        (0..triangles.len())
            .map(|t| {
                while next(run, face_of(t)) {
                    run += 1;
                }
                run as u32
            })
            .collect()
    };
    let by = |key: &dyn Fn(&Run) -> usize| -> Vec<usize> { run_of.iter().map(|&r| key(&runs[r as usize])).collect() };
    let mut piece_of = by(&|run| run.object);
    if piece_of.iter().all(|&object| object == 0) {
        piece_of = by(&|run| run.group);
        if shared(&triangles, &piece_of, points) {
            piece_of.fill(0);
        }
    }
    let mut place = vec![usize::MAX; names.all.len() + 1];
    let mut out: Vec<Piece> = Vec::new();
    for (t, &name) in triangles.into_iter().zip(&piece_of) {
        if place[name] == usize::MAX {
            place[name] = out.len();
            let name = name.checked_sub(1).map_or(String::new(), |k| names.all[k].clone());
            out.push(Piece { name, triangles: Vec::new() });
        }
        out[place[name]].triangles.push(t);
    }
    out
}

fn shared(triangles: &[[i32; 3]], piece_of: &[usize], points: usize) -> bool {
    let mut owner = vec![usize::MAX; points];
    triangles.iter().zip(piece_of).any(|(t, &piece)| {
        t.iter().any(|&v| {
            let before = std::mem::replace(&mut owner[v as usize], piece);
            before != usize::MAX && before != piece
        })
    })
}

/// Names numbered from 1; 0 is no name.
#[derive(Default)]
struct Names {
    all: Vec<String>,
    numbers: HashMap<String, usize>,
}

impl Names {
    fn number(&mut self, name: &[u8]) -> usize {
        let name = plain(name);
        if name.is_empty() {
            return 0;
        }
        *self.numbers.entry(name).or_insert_with_key(|name| {
            self.all.push(name.clone());
            self.all.len()
        })
    }
}

fn missing(vertex: i64, count: usize) -> String {
    format!("names vertex {vertex}, and there are {count}")
}

/// Red, green and blue from 0 to 1 after the coordinates, as some programs write them.
fn color<'a>(mut row: impl Iterator<Item = &'a [u8]>) -> Option<[u8; 4]> {
    let mut out = [255; 4];
    for value in &mut out[..3] {
        let share = number(row.next()?)?;
        *value = if share.is_finite() { (share.clamp(0.0, 1.0) * 255.0).round_ties_even() as u8 } else { 0 };
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

    fn read(data: &str) -> Result<MeshFile, Fault> {
        super::read(data.as_bytes(), &|| false)
    }

    fn parts(data: &str) -> Vec<(String, Vec<[i32; 3]>)> {
        read(&format!("{CORNERS}{data}")).unwrap().pieces.into_iter().map(|p| (p.name, p.triangles)).collect()
    }

    #[test]
    fn numbers_of_vertices_count_forward_and_back() {
        let found =
            read("\u{feff}v 0 0 0\nv 1 0 0\nv 0 1 0 # here\nf 1/7/9 2//9 3\nv 5 0 0\nf -1 -2 \\\n-3 # back\n").unwrap();
        assert_eq!(found.pieces[0].triangles, [[0, 1, 2], [3, 2, 1]]);
        assert_eq!(found.paint, Paint::None);
    }

    #[test]
    fn objects_are_parts_wherever_their_faces_stand() {
        let found = parts("o a b\nusemtl red\nf 1 2 3\no c\ng x\nf 1 2 4\no a b\ns off\nf 2 3 4\no empty\n");
        assert_eq!(found, [("a b".into(), vec![[0, 1, 2], [1, 2, 3]]), ("c".into(), vec![[0, 1, 3]])]);
    }

    #[test]
    fn groups_are_parts_where_they_share_no_vertex() {
        let more = "v 9 0 0\nv 9 1 0\nv 9 0 1\n";
        let found = parts(&format!("{more}g one\nf 1 2 3 4\ng two\nf 5 6 7\n"));
        assert_eq!(found.iter().map(|p| (p.0.as_str(), p.1.len())).collect::<Vec<_>>(), [("one", 2), ("two", 1)]);
        let regions = parts("g one\nf 1 2 3\ng two\nf 2 3 4\n");
        assert_eq!(regions, [(String::new(), vec![[0, 1, 2], [1, 2, 3]])]);
    }

    #[test]
    fn colours_stand_behind_coordinates_of_all_vertices_or_of_none() {
        let colored = "v 0 0 0 1 0.5 nan\nv 1 0 0 0 0 2\nv 0 1 0 1 1 1\n";
        let found = read(&format!("{colored}f 1 2 3\n")).unwrap();
        assert_eq!(found.paint, Paint::Points(vec![[255, 128, 0, 255], [0, 0, 255, 255], [255; 4]]));
        assert_eq!(read(&format!("{colored}v 0 0 0\nf 1 2 3\n")).unwrap().paint, Paint::None);
    }

    #[test]
    fn broken_lines_are_named() {
        let line = |text: &str| match read(&format!("{CORNERS}{text}")) {
            Err(Fault::Broken(what)) => what,
            other => panic!("{other:?}"),
        };
        assert_eq!(line("f 1 2 9\nf 1 2 3\n"), "line 5 names vertex 9, and there are 4");
        assert_eq!(line("f 1 2 0\n"), "line 5 names vertex 0, and there are 4");
        assert_eq!(line("f 1 2 -5\n"), "line 5 names vertex -5, and there are 4");
        assert_eq!(line("f 1 2 x\n"), "line 5 has \"x\" for a vertex");
        assert_eq!(line("v 1 2\n"), "line 5 has 2 coordinates instead of 3");
        assert_eq!(
            read("f 99999999999999999999 1 2\n"),
            Err(Fault::Broken("line 1 has \"99999999999999999999\" for a vertex".into()))
        );
    }
}
