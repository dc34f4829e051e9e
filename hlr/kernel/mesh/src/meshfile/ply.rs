//! Reads PLY: a header that names the elements, then text, or binary numbers of either byte order.

use super::ply_type::Type;
use super::polygon::Faces;
use super::text::{Lines, number, shown, words};
use super::{Fault, MOST_POINTS, MeshFile, Paint, Piece, Stop, counted, polled};

struct Property {
    name: Vec<u8>,
    value: Type,
    /// For a list: the type of its length.
    length: Option<Type>,
}

struct Element {
    name: Vec<u8>,
    count: usize,
    properties: Vec<Property>,
}

impl Element {
    fn place(&self, names: &[&[u8]]) -> Option<usize> {
        self.properties.iter().position(|p| names.contains(&p.name.as_slice()))
    }

    fn places<const N: usize>(&self, names: [&[u8]; N]) -> Option<[usize; N]> {
        let found = names.map(|name| self.place(&[name]));
        found.iter().all(Option::is_some).then(|| found.map(|at| at.unwrap_or_default()))
    }

    /// Columns of red, green and blue, and of the opacity if there is one.
    fn paint(&self) -> Option<([usize; 3], Option<usize>)> {
        Some((self.places([b"red", b"green", b"blue"])?, self.place(&[b"alpha"])))
    }

    fn shades(&self, (rgb, alpha): ([usize; 3], Option<usize>), row: &[f64]) -> [u8; 4] {
        let shade = |at: usize| self.properties[at].value.shade(row[at]);
        [shade(rgb[0]), shade(rgb[1]), shade(rgb[2]), alpha.map_or(255, shade)]
    }
}

/// Where the numbers come from.
enum Body<'a> {
    Text(Lines<'a>),
    Binary { rest: &'a [u8], little: bool },
}

pub fn read(data: &[u8], stop: Stop) -> Result<MeshFile, Fault> {
    let (mut body, elements) = header(data)?;
    let text = matches!(body, Body::Text(_));
    let rows: usize = elements.iter().map(|e| e.count).fold(0, usize::saturating_add);
    let need = elements.iter().map(|e| least(e, text)).fold(0, usize::saturating_add);
    if need > data.len() {
        let announced = format!("its header announces at least {need} bytes of data, the file has {}", data.len());
        return Err(Fault::Cut(announced));
    }
    let mut found = MeshFile::default();
    let (mut faces, mut vertex_colors, mut face_colors) = (Faces::default(), Vec::new(), Vec::new());
    let (mut row, mut list) = (Vec::new(), Vec::new());
    let mut done = 0;
    for element in &elements {
        let is_vertex = element.name == b"vertex";
        let is_face = element.name == b"face";
        let place = if is_vertex { element.places([b"x", b"y", b"z"]) } else { None };
        let corners = if is_face { element.place(&[b"vertex_indices", b"vertex_index"]) } else { None };
        let corners = corners.or_else(|| element.properties.iter().position(|p| is_face && p.length.is_some()));
        let paint = if is_vertex || is_face { element.paint() } else { None };
        // Rows without properties take no bytes: none are read.
        let count = if element.properties.is_empty() && !text { 0 } else { element.count };
        for _ in 0..count {
            polled(done, stop)?;
            body.row(element, corners, &mut row, &mut list, Progress(done, rows))?;
            done += 1;
            if let Some(place) = place {
                if found.points.len() >= MOST_POINTS {
                    return Err(Fault::Broken("it has too many vertices".into()));
                }
                found.points.push(place.map(|k| row[k]));
                vertex_colors.extend(paint.map(|paint| element.shades(paint, &row)));
            }
            if corners.is_some() && faces.push(&list) {
                face_colors.extend(paint.map(|paint| element.shades(paint, &row)));
            }
        }
    }
    let (triangles, face) = faces.triangles(&found.points, stop)?;
    if !vertex_colors.is_empty() {
        found.paint = Paint::Points(vertex_colors);
    } else if !face_colors.is_empty() {
        found.paint = Paint::Triangles(match face {
            Some(face) => face.iter().map(|&f| face_colors[f as usize]).collect(),
            None => face_colors,
        });
    }
    found.pieces.push(Piece { name: String::new(), triangles });
    Ok(found)
}

/// Least number of bytes of one row of an element; text has a digit and a blank per number.
fn least(element: &Element, text: bool) -> usize {
    let size = |p: &Property| if text { 2 } else { p.length.unwrap_or(p.value).size() };
    element.count.saturating_mul(element.properties.iter().map(size).sum())
}

fn header(data: &[u8]) -> Result<(Body<'_>, Vec<Element>), Fault> {
    let broken = |what: String| Err(Fault::Broken(what));
    let mut elements: Vec<Element> = Vec::new();
    let (mut form, mut at) = (None, 0);
    // Line by line, and not by `Lines`: what follows the header is binary.
    while let Some(end) = data[at..].iter().position(|&b| b == b'\n') {
        let line = data[at..at + end].trim_ascii();
        at += end + 1;
        let row: Vec<&[u8]> = words(line).collect();
        match row[..] {
            [b"format", name, ..] => form = Some(name),
            [b"element", name, count] => {
                let Some(count) = std::str::from_utf8(count).ok().and_then(|text| text.parse().ok()) else {
                    return broken(format!("its header has {} for a number of elements", shown(count)));
                };
                elements.push(Element { name: name.to_vec(), count, properties: Vec::new() });
            }
            [b"property", ref types @ .., name] if !types.is_empty() => {
                let (length, value) = match types {
                    [value] => (None, Type::named(value)),
                    [b"list", length, value] => (Some(Type::named(length)), Type::named(value)),
                    _ => (None, None),
                };
                let (Some(value), false) = (value, length == Some(None)) else {
                    return broken(format!("its header has a property {} of no known type", shown(name)));
                };
                let Some(element) = elements.last_mut() else {
                    return broken("its header has a property before any element".into());
                };
                element.properties.push(Property { name: name.to_vec(), value, length: length.flatten() });
            }
            [b"end_header", ..] => {
                let rest = &data[at..];
                return match form {
                    Some(b"ascii") => Ok((Body::Text(Lines::new(rest)), elements)),
                    Some(b"binary_little_endian") => Ok((Body::Binary { rest, little: true }, elements)),
                    Some(b"binary_big_endian") => Ok((Body::Binary { rest, little: false }, elements)),
                    form => broken(format!("its header has the format {}", shown(form.unwrap_or_default()))),
                };
            }
            _ => {}
        }
    }
    broken("its header does not end".into())
}

/// Progress of reading: rows done, of all.
#[derive(Clone, Copy)]
struct Progress(usize, usize);

impl Progress {
    /// The error for a row that is missing.
    fn missing(self) -> Fault {
        let Progress(done, all) = self;
        Fault::Cut(format!("its header announces {} of numbers, the file has {done}", counted(all, "row")))
    }

    /// The error for a row in which the file ends.
    fn unfinished(self) -> Fault {
        if self.is_last() { Fault::Cut("its last row is not whole".into()) } else { self.missing() }
    }

    fn is_last(self) -> bool {
        self.0 + 1 == self.1
    }
}

impl Body<'_> {
    /// The next row of an element: its single numbers, 0 where lists are, and the list at `wanted`.
    fn row(
        &mut self,
        element: &Element,
        wanted: Option<usize>,
        row: &mut Vec<f64>,
        list: &mut Vec<i64>,
        at: Progress,
    ) -> Result<(), Fault> {
        match self {
            Body::Binary { rest, little } => filled(element, wanted, row, list, |what| {
                let (bytes, after) = rest.split_at_checked(what.size()).ok_or_else(|| at.unfinished())?;
                *rest = after;
                Ok(what.decoded(bytes, *little))
            }),
            Body::Text(lines) => {
                let line = loop {
                    let line = lines.next_line().ok_or_else(|| at.missing())?.trim_ascii();
                    if !line.is_empty() {
                        break line;
                    }
                };
                let place = lines.number;
                let mut row_words = words(line);
                filled(element, wanted, row, list, |what| {
                    let last = at.is_last();
                    let short = || {
                        if last {
                            at.unfinished()
                        } else {
                            Fault::Broken(format!("line {place} of its data is not whole"))
                        }
                    };
                    let word = row_words.next().ok_or_else(short)?;
                    let wrong = || Fault::Broken(format!("line {place} of its data has {} for a number", shown(word)));
                    number(word).map(|value| what.rounded(value)).ok_or_else(wrong)
                })
            }
        }
    }
}

fn filled(
    element: &Element,
    wanted: Option<usize>,
    row: &mut Vec<f64>,
    list: &mut Vec<i64>,
    mut take: impl FnMut(Type) -> Result<f64, Fault>,
) -> Result<(), Fault> {
    row.clear();
    list.clear();
    for (k, property) in element.properties.iter().enumerate() {
        let Some(length) = property.length else {
            row.push(take(property.value)?);
            continue;
        };
        row.push(0.0);
        // The announced length needs no check: each item takes bytes, and the file ends.
        for _ in 0..take(length)? as usize {
            let value = take(property.value)?;
            if wanted == Some(k) {
                list.push(if value.fract() == 0.0 { value as i64 } else { -1 });
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const XYZ: &str = "property float x\nproperty double y\nproperty float z\n";

    fn head(form: &str, vertices: usize, faces: usize, more: &str) -> Vec<u8> {
        format!(
            "ply\nformat {form} 1.0\ncomment by hand\nelement vertex {vertices}\n{XYZ}property uchar red\nproperty uchar green\n\
             property uchar blue\nelement face {faces}\nproperty list uchar int vertex_indices\n{more}end_header\n"
        )
        .into_bytes()
    }

    fn read(data: &[u8]) -> Result<MeshFile, Fault> {
        super::read(data, &|| false)
    }

    fn square() -> MeshFile {
        let points = vec![[0.0, 0.0, 0.5], [1.0, 0.0, 0.5], [1.0, 1.0, 0.5], [0.0, 1.0, 0.5]];
        let triangles = vec![[0, 1, 2], [0, 2, 3], [0, 1, 2]];
        let paint = Paint::Points((0..4).map(|k| [255, 0, k, 255]).collect());
        MeshFile { points, pieces: vec![Piece { name: String::new(), triangles }], paint }
    }

    #[test]
    fn text_and_both_orders_of_bytes_hold_the_same() {
        let expected = square();
        let mut text = head("ascii", 4, 2, "");
        for (k, [x, y, z]) in expected.points.iter().enumerate() {
            text.extend(format!("{x} {y} {z} 255 0 {k} \n\n").into_bytes());
        }
        text.extend(b"4 0 1 2 3\n3 0 1 2");
        assert_eq!(read(&text).unwrap(), expected);
        for big in [false, true] {
            let ordered =
                |bytes: &[u8]| -> Vec<u8> { if big { bytes.iter().rev().copied().collect() } else { bytes.to_vec() } };
            let mut data = head(if big { "binary_big_endian" } else { "binary_little_endian" }, 4, 2, "");
            for (k, [x, y, z]) in expected.points.iter().enumerate() {
                data.extend(ordered(&(*x as f32).to_le_bytes()));
                data.extend(ordered(&y.to_le_bytes()));
                data.extend(ordered(&(*z as f32).to_le_bytes()));
                data.extend([255, 0, k as u8]);
            }
            for face in [&[0, 1, 2, 3][..], &[0, 1, 2]] {
                data.push(face.len() as u8);
                face.iter().for_each(|v: &i32| data.extend(ordered(&v.to_le_bytes())));
            }
            assert_eq!(read(&data).unwrap(), expected);
            data.pop();
            assert_eq!(read(&data), Err(Fault::Cut("its last row is not whole".into())));
        }
    }

    #[test]
    fn single_numbers_of_a_text_are_single() {
        let head = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty double y\nproperty int z\nend_header\n";
        let found = read(format!("{head}0.1 0.1 7\n").as_bytes()).unwrap();
        assert_eq!(found.points, [[f64::from(0.1f32), 0.1, 7.0]]);
    }

    #[test]
    fn a_triangle_has_the_colour_of_its_face() {
        let mut data = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n\
            property list uchar int vertex_index\nproperty float red\nproperty float green\nproperty float blue\nproperty float alpha\n\
            end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
            .to_string();
        data += "3 0 1 2 1 0 0 1\n4 0 1 2 3 nan 0.5 7 0\n";
        let found = read(data.as_bytes()).unwrap();
        let second = [0, 128, 255, 0];
        assert_eq!(found.paint, Paint::Triangles(vec![[255, 0, 0, 255], second, second]));
    }

    #[test]
    fn headers_that_lie() {
        let cut = |data: &[u8]| match read(data) {
            Err(Fault::Cut(what)) => what,
            other => panic!("{other:?}"),
        };
        let huge = head("binary_little_endian", usize::MAX, 1, "");
        assert_eq!(
            cut(&huge),
            format!("its header announces at least {} bytes of data, the file has {}", usize::MAX, huge.len())
        );
        let rows = [&head("ascii", 2, 1, "")[..], b"0 0 0 1 1 1\n"].concat();
        assert_eq!(cut(&rows), "its header announces 3 rows of numbers, the file has 1");
        let list = b"ply\nformat binary_big_endian 1.0\nelement face 1\nproperty list uint int v\nend_header\n\xff\xff\xff\xff\0\0\0\0";
        assert_eq!(cut(list), "its last row is not whole");
        let nothing = b"ply\nformat binary_big_endian 1.0\nelement a 999999999999999999\nend_header\n";
        assert_eq!(read(nothing).unwrap().points.len(), 0);
    }

    #[test]
    fn broken_headers_and_rows() {
        let broken = |data: &[u8]| match read(data) {
            Err(Fault::Broken(what)) => what,
            other => panic!("{other:?}"),
        };
        assert_eq!(broken(b"ply\nformat ascii 1.0\n"), "its header does not end");
        assert_eq!(broken(b"ply\nformat x 1.0\nend_header\n"), "its header has the format \"x\"");
        assert_eq!(broken(b"ply\nelement vertex -3\n"), "its header has \"-3\" for a number of elements");
        assert_eq!(broken(b"ply\nproperty float x\n"), "its header has a property before any element");
        assert_eq!(
            broken(b"ply\nelement a 1\nproperty list uchar x\n"),
            "its header has a property \"x\" of no known type"
        );
        let row = |line: &str| [&head("ascii", 1, 1, "")[..], line.as_bytes(), b"\n3 0 0 0\n"].concat();
        assert_eq!(broken(&row("0 0 0 1")), "line 1 of its data is not whole");
        assert_eq!(broken(&row("0 a 0 1 1 1")), "line 1 of its data has \"a\" for a number");
    }

    #[test]
    fn numbers_of_all_sizes() {
        for (name, bytes, value) in [
            ("char", &[0xfe][..], -2.0),
            ("uint16", &[0x34, 0x12], 4660.0),
            ("int64", &[0xff; 8], -1.0),
            ("uint64", &[1, 0, 0, 0, 0, 0, 0, 0], 1.0),
            ("float", &[0, 0, 0x80, 0xbf], -1.0),
            ("float64", &[0, 0, 0, 0, 0, 0, 0xf8, 0x3f], 1.5),
        ] {
            let kind = Type::named(name.as_bytes()).unwrap();
            assert_eq!((kind.size(), kind.decoded(bytes, true)), (bytes.len(), value), "{name}");
            let back: Vec<u8> = bytes.iter().rev().copied().collect();
            assert_eq!(kind.decoded(&back, false), value, "{name}");
        }
        assert_eq!(
            (Type::Unsigned(2).shade(65535.0), Type::Float(4).shade(f64::NAN), Type::Signed(4).shade(-9.0)),
            (255, 0, 0)
        );
    }
}
