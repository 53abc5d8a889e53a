//! Reads files of polygonal data and of curved cells, as VTK's XML format describes them.

// Each test uses a part of it.
#![allow(dead_code)]

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use roxmltree::{Document, Node};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The only piece of a file; of each array the numbers.
pub struct Piece {
    pub points: Vec<f64>,
    /// How many cells of each kind the file says there are.
    pub lines: usize,
    pub verts: usize,
    /// What each cell joins, and where in this each ends.
    pub connectivity: Vec<f64>,
    pub offsets: Vec<f64>,
    /// Kinds of curved cells.
    pub types: Vec<f64>,
    pub point_data: BTreeMap<String, Vec<f64>>,
    pub cell_data: BTreeMap<String, Vec<f64>>,
}

impl Piece {
    pub fn read(path: &Path) -> Piece {
        let text = fs::read_to_string(path).unwrap();
        let document = Document::parse(&text).unwrap();
        let root = document.root_element();
        assert_eq!(root.attribute("byte_order"), Some("LittleEndian"));
        assert_eq!(root.attribute("header_type"), Some("UInt64"));
        let piece = document.descendants().find(|n| n.has_tag_name("Piece"));
        let piece = piece.unwrap();
        let part = |tag: &str| arrays(piece.children().find(|n| n.has_tag_name(tag)));
        let count = |name: &str| piece.attribute(name).map_or(0, |n| n.parse().unwrap());
        let mut cells = part("Lines");
        cells.extend(part("Verts"));
        cells.extend(part("Cells"));
        let read = Piece {
            points: part("Points").remove("Points").unwrap(),
            lines: count("NumberOfLines"),
            verts: count("NumberOfVerts"),
            connectivity: cells.remove("connectivity").unwrap(),
            offsets: cells.remove("offsets").unwrap(),
            types: cells.remove("types").unwrap_or_default(),
            point_data: part("PointData"),
            cell_data: part("CellData"),
        };
        assert_eq!(read.points.len(), 3 * count("NumberOfPoints"));
        read
    }

    pub fn at_points(&self, name: &str) -> &[f64] {
        &self.point_data[name]
    }
}

fn arrays(parent: Option<Node>) -> BTreeMap<String, Vec<f64>> {
    let children = parent.into_iter().flat_map(|node| node.children());
    let arrays = children.filter(|node| node.has_tag_name("DataArray"));
    arrays
        .map(|array| (array.attribute("Name").unwrap().to_owned(), numbers(array)))
        .collect()
}

/// A count of bytes and the bytes, in base64.
fn numbers(array: Node) -> Vec<f64> {
    assert_eq!(array.attribute("format"), Some("binary"));
    let bytes = BASE64_STANDARD.decode(array.text().unwrap().trim());
    let bytes = bytes.unwrap();
    let mut words = bytes
        .chunks(8)
        .map(|word| <[u8; 8]>::try_from(word).unwrap());
    let count = u64::from_le_bytes(words.next().unwrap());
    assert_eq!(count, 8 * words.len() as u64);
    match array.attribute("type").unwrap() {
        "Float64" => words.map(f64::from_le_bytes).collect(),
        "Int64" => words.map(|word| i64::from_le_bytes(word) as f64).collect(),
        other => panic!("an array of {other}"),
    }
}
