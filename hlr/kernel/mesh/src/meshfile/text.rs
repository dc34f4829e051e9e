//! Lines and words of text files, without copying them.

use std::borrow::Cow;

/// Lines of a text, however they end; `number` counts them from 1.
pub struct Lines<'a> {
    rest: &'a [u8],
    pub number: usize,
}

impl<'a> Lines<'a> {
    pub fn new(text: &'a [u8]) -> Lines<'a> {
        Lines { rest: text, number: 0 }
    }

    pub fn next_line(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let end = self.rest.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(self.rest.len());
        let line = &self.rest[..end];
        let over = if self.rest[end..].starts_with(b"\r\n") { 2 } else { 1 };
        self.rest = &self.rest[(end + over).min(self.rest.len())..];
        Some(line)
    }

    /// The next line; a line that ends with a backslash is joined with the one after it.
    pub fn next_joined(&mut self) -> Option<Cow<'a, [u8]>> {
        let line = self.next_line()?;
        if line.last() != Some(&b'\\') {
            return Some(Cow::Borrowed(line));
        }
        let mut joined = line.to_vec();
        while joined.last() == Some(&b'\\') {
            joined.pop();
            joined.extend(self.next_line().unwrap_or_default());
        }
        Some(Cow::Owned(joined))
    }

    /// The next line that holds a word, without what follows a `#`.
    pub fn next_row(&mut self) -> Option<&'a [u8]> {
        loop {
            let line = self.next_line()?;
            let row = line.split(|&b| b == b'#').next().unwrap_or_default().trim_ascii();
            if !row.is_empty() {
                return Some(row);
            }
        }
    }
}

/// Words between blanks.
pub fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> + Clone {
    line.split(|b| b.is_ascii_whitespace()).filter(|word| !word.is_empty())
}

/// The first word, and what follows it.
pub fn first_word(line: &[u8]) -> (&[u8], &[u8]) {
    let line = line.trim_ascii_start();
    let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
    line.split_at(end)
}

/// A number; what some programs write where they had none ("1.#QNAN") is none, and no reason to refuse a file.
pub fn number(word: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(word).ok()?;
    let plain = text.parse().ok();
    plain.or_else(|| text.trim_start_matches(['-', '+']).starts_with("1.#").then_some(f64::NAN))
}

pub fn whole(word: &[u8]) -> Option<i64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// A name: UTF-8, or else Latin-1, which any bytes are.
pub fn plain(name: &[u8]) -> String {
    let name = name.trim_ascii();
    let text = std::str::from_utf8(name).map_or_else(|_| name.iter().map(|&b| char::from(b)).collect(), str::to_owned);
    text.chars().filter(|c| !c.is_control()).collect()
}

/// A word as an error message shows it.
pub fn shown(word: &[u8]) -> String {
    let text: String = String::from_utf8_lossy(word).chars().filter(|c| !c.is_control()).take(20).collect();
    format!("\"{text}\"")
}

/// The three coordinates at the front of a row, or what is wrong with them.
pub fn coordinates<'a>(mut row: impl Iterator<Item = &'a [u8]>) -> Result<[f64; 3], String> {
    let mut point = [0.0; 3];
    for (k, value) in point.iter_mut().enumerate() {
        let word = row.next().ok_or_else(|| format!("has {k} coordinates instead of 3"))?;
        *value = number(word).ok_or_else(|| format!("has {} for a coordinate", shown(word)))?;
    }
    Ok(point)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_three_ways_and_go_on_after_a_backslash() {
        let mut lines = Lines::new(b"a\r\nb\rc\\\nd\n\n# x\ne # y");
        assert_eq!((lines.next_line(), lines.next_line()), (Some(&b"a"[..]), Some(&b"b"[..])));
        assert_eq!(lines.next_joined().as_deref(), Some(&b"cd"[..]));
        assert_eq!((lines.next_row(), lines.number), (Some(&b"e"[..]), 7));
        assert_eq!(lines.next_row(), None);
    }

    #[test]
    fn numbers() {
        assert_eq!(number(b"-1.5e+3"), Some(-1500.0));
        assert!(number(b"-1.#QNAN").is_some_and(f64::is_nan));
        assert_eq!((number(b"a"), number(b"0,5"), number(b"\xff")), (None, None, None));
        assert_eq!((plain(b" a\xc3\xa4 "), plain(b"\xe4\x01b")), ("aä".into(), "äb".into()));
        assert_eq!(coordinates(words(b"1 2")), Err("has 2 coordinates instead of 3".into()));
    }
}
