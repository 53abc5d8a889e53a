//! VTK's XML files: points, lines through them, curved quadrilaterals, and numbers that belong to
//! these; written inline in base64, not compressed.

use base64::prelude::BASE64_STANDARD;
use base64::write::EncoderWriter;
use std::io::{self, Write};

/// How the points are drawn.
pub(super) enum Cells {
    /// Each by itself.
    Points,
    /// A line through each so many in a row.
    Lines(usize),
    /// Curved quadrilaterals of so many points along their sides each, in the order of VTK's
    /// Lagrange cells.
    Quadrilaterals(Vec<[usize; 2]>),
}

/// VTK's number of a curved quadrilateral.
const LAGRANGE_QUADRILATERAL: i64 = 70;

/// What is known at each point, or of each cell.
pub(super) struct Field {
    name: &'static str,
    values: Values,
}

enum Values {
    /// A number of something each.
    Ids(Vec<i64>),
    /// Three components each.
    Vectors(Vec<f64>),
    Numbers(Vec<f64>),
    /// Degrees of curved cells, as three numbers each.
    Degrees(Vec<f64>),
}

impl Field {
    pub(super) fn ids(name: &'static str, ids: impl Iterator<Item = usize>) -> Self {
        let values = Values::Ids(ids.map(|id| id as i64).collect());
        Field { name, values }
    }

    /// `components`: three of each vector together.
    pub(super) fn vectors(name: &'static str, components: Vec<f64>) -> Self {
        let values = Values::Vectors(components);
        Field { name, values }
    }

    pub(super) fn numbers(name: &'static str, numbers: Vec<f64>) -> Self {
        let values = Values::Numbers(numbers);
        Field { name, values }
    }

    /// Polynomial degrees of curved quadrilaterals along their sides.
    pub(super) fn degrees(degrees: impl Iterator<Item = [usize; 2]>) -> Self {
        let three = degrees.flat_map(|[p, q]| [p as f64, q as f64, 0.0]);
        Field {
            name: "HigherOrderDegrees",
            values: Values::Degrees(three.collect()),
        }
    }
}

/// The content of one file.
pub(super) struct PolyData {
    /// Three coordinates of each point together.
    pub(super) positions: Vec<f64>,
    pub(super) cells: Cells,
    pub(super) point_data: Vec<Field>,
    pub(super) cell_data: Vec<Field>,
}

impl PolyData {
    pub(super) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let points = self.positions.len() / 3;
        let (set, kind) = match self.cells {
            Cells::Points => ("PolyData", "Verts"),
            Cells::Lines(_) => ("PolyData", "Lines"),
            Cells::Quadrilaterals(_) => ("UnstructuredGrid", "Cells"),
        };
        let ends = self.ends(points);
        let cells = ends.len();
        writeln!(out, "{DECLARATION}")?;
        writeln!(
            out,
            r#"<VTKFile type="{set}" version="1.0" {BYTE_ORDER} header_type="UInt64">"#
        )?;
        writeln!(out, "  <{set}>")?;
        writeln!(
            out,
            r#"    <Piece NumberOfPoints="{points}" NumberOf{kind}="{cells}">"#
        )?;
        write_fields(out, "PointData", &self.point_data)?;
        write_fields(out, "CellData", &self.cell_data)?;
        writeln!(out, "      <Points>")?;
        write_reals(out, ("Points", 3), &self.positions)?;
        writeln!(out, "      </Points>\n      <{kind}>")?;
        write_integers(out, "connectivity", (0..points).map(|point| point as i64))?;
        write_integers(out, "offsets", ends.into_iter())?;
        if matches!(self.cells, Cells::Quadrilaterals(_)) {
            let kinds = (0..cells).map(|_| LAGRANGE_QUADRILATERAL);
            write_integers(out, "types", kinds)?;
        }
        writeln!(out, "      </{kind}>\n    </Piece>\n  </{set}>\n</VTKFile>")
    }

    /// Number of points up to the end of each cell.
    fn ends(&self, points: usize) -> Vec<i64> {
        let all_of = |of_cell: usize| (1..=points / of_cell).map(move |k| (k * of_cell) as i64);
        match &self.cells {
            Cells::Points => all_of(1).collect(),
            Cells::Lines(of_line) => all_of(*of_line).collect(),
            Cells::Quadrilaterals(sides) => {
                let counts = sides.iter().map(|[p, q]| p * q);
                let ends = counts.scan(0, |end, count| {
                    *end += count;
                    Some(*end as i64)
                });
                ends.collect()
            }
        }
    }
}

/// The first line of each file.
pub(super) const DECLARATION: &str = r#"<?xml version="1.0" encoding="UTF-8"?>"#;

/// In which order the bytes of numbers come.
pub(super) const BYTE_ORDER: &str = r#"byte_order="LittleEndian""#;

/// The fields, of which the first of each kind is what programs show unless told otherwise.
fn write_fields(out: &mut dyn Write, tag: &str, fields: &[Field]) -> io::Result<()> {
    write!(out, "      <{tag}")?;
    let is_ids = |field: &&Field| matches!(field.values, Values::Ids(_));
    if let Some(first) = fields.iter().find(is_ids) {
        write!(out, r#" Scalars="{}""#, first.name)?;
    }
    let is_vectors = |field: &&Field| matches!(field.values, Values::Vectors(_));
    if let Some(first) = fields.iter().find(is_vectors) {
        write!(out, r#" Vectors="{}""#, first.name)?;
    }
    let is_degrees = |field: &&Field| matches!(field.values, Values::Degrees(_));
    if let Some(first) = fields.iter().find(is_degrees) {
        write!(out, r#" HigherOrderDegrees="{}""#, first.name)?;
    }
    writeln!(out, ">")?;
    for field in fields {
        match &field.values {
            Values::Ids(ids) => write_integers(out, field.name, ids.iter().copied())?,
            Values::Vectors(components) | Values::Degrees(components) => {
                write_reals(out, (field.name, 3), components)?;
            }
            Values::Numbers(numbers) => write_reals(out, (field.name, 1), numbers)?,
        }
    }
    writeln!(out, "      </{tag}>")
}

fn write_reals(
    out: &mut dyn Write,
    (name, components): (&str, usize),
    values: &[f64],
) -> io::Result<()> {
    let kind = format!(r#"type="Float64" Name="{name}" NumberOfComponents="{components}""#);
    write_array(out, &kind, values.iter().map(|x| x.to_le_bytes()))
}

fn write_integers(
    out: &mut dyn Write,
    name: &str,
    values: impl ExactSizeIterator<Item = i64>,
) -> io::Result<()> {
    let kind = format!(r#"type="Int64" Name="{name}""#);
    write_array(out, &kind, values.map(i64::to_le_bytes))
}

/// Together in base64: a count of bytes, and the bytes.
fn write_array(
    out: &mut dyn Write,
    kind: &str,
    values: impl ExactSizeIterator<Item = [u8; 8]>,
) -> io::Result<()> {
    write!(out, r#"        <DataArray {kind} format="binary">"#)?;
    let mut encoder = EncoderWriter::new(&mut *out, &BASE64_STANDARD);
    encoder.write_all(&(8 * values.len() as u64).to_le_bytes())?;
    for bytes in values {
        encoder.write_all(&bytes)?;
    }
    encoder.finish()?;
    drop(encoder);
    writeln!(out, "</DataArray>")
}

/// `text` as the value of an attribute; nothing if XML has no way to write one of its characters.
pub(super) fn escaped(text: &str) -> Option<String> {
    let mut value = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => value.push_str("&amp;"),
            '<' => value.push_str("&lt;"),
            '>' => value.push_str("&gt;"),
            '"' => value.push_str("&quot;"),
            // As they are, they would be read as spaces.
            '\t' | '\n' | '\r' => value.push_str(&format!("&#{};", character as u32)),
            '\0'..' ' | '\u{fffe}' | '\u{ffff}' => return None,
            _ => value.push(character),
        }
    }
    Some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_hold_any_text_that_xml_can_hold() {
        let text = "a<b> & \"c\"\t'd'\n\u{e9}";
        let value = escaped(text).unwrap();
        let document = format!("{DECLARATION}\n<x name=\"{value}\"/>");
        let read = roxmltree::Document::parse(&document).unwrap();
        assert_eq!(read.root_element().attribute("name"), Some(text));
        for text in ["\0", "a\u{1b}", "\u{ffff}"] {
            assert_eq!(escaped(text), None);
        }
    }
}
