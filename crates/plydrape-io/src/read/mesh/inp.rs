//! Abaqus input files: parts and instances, or nodes and elements alone.
//!
//! A line with one asterisk is a keyword with parameters, and goes on in the next line if it ends in a
//! comma; two asterisks are a comment; other lines are data of the keyword above. Instances are moved
//! first and then turned about an axis. Sets, materials and steps are passed over; a keyword that would
//! change the geometry is refused.

use super::element::{Element, element};
use super::instance::{Placing, turned};
use super::text::{CORRECT, Lines, refused};
use crate::Error;
use crate::store::size;
use plydrape::mold::mesh::{Role, Skipped, Soup};
use std::collections::{HashMap, HashSet};

/// Keywords that make or move nodes and elements, and what to do about them.
const REFUSED: [(&str, &str); 11] = [
    ("INCLUDE", "paste the file in its place"),
    ("SYSTEM", "write the nodes in global coordinates"),
    ("NGEN", "write out the nodes"),
    ("NCOPY", "write out the nodes"),
    ("NFILL", "write out the nodes"),
    ("NMAP", "write out the nodes"),
    ("ELGEN", "write out the elements"),
    ("ELCOPY", "write out the elements"),
    ("SYMMETRIC MODEL GENERATION", "export the whole model"),
    ("IMPORT", "export the model with its mesh"),
    ("SUBSTRUCTURE PATH", "export the model with its mesh"),
];

/// Nodes and elements that belong together: of a part, of an instance, or of the file itself.
#[derive(Debug, Default)]
struct Scope {
    /// What messages call it.
    name: String,
    /// Nodes by number: place and line.
    nodes: HashMap<u64, ([f64; 3], usize)>,
    elements: Vec<SurfaceElement>,
    /// Elements that may be part of the surface and cannot be read: which of the skipped types, and their nodes.
    lost: Vec<(usize, Vec<u64>)>,
}

/// A surface element.
#[derive(Debug)]
struct SurfaceElement {
    number: u64,
    line: usize,
    /// Numbers of its corner nodes.
    corners: [u64; 4],
    count: usize,
}

/// A part in its place.
#[derive(Debug)]
struct Instance {
    part: Option<usize>,
    /// Nodes and elements written inside the instance.
    own: Scope,
    placing: Placing,
}

/// What the data lines below a keyword mean.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Data {
    Ignored,
    /// Of elements that are left out, by the number of their type.
    Skipped(usize),
    Nodes,
    Elements {
        nodes: usize,
        corners: usize,
    },
    Placing {
        lines: usize,
    },
}

/// Where nodes and elements go.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Section {
    File,
    Part,
    Instance,
}

/// The file as far as it has been read.
struct Reader<'a> {
    file: &'a str,
    lines: Lines<'a>,
    flat: Scope,
    parts: Vec<Scope>,
    instances: Vec<Instance>,
    place: Section,
    data: Data,
    /// Numbers of an element that goes on in the next line.
    pending: Vec<u64>,
    /// Types of elements that are left out.
    skipped: Vec<Skipped>,
}

pub(super) fn read(file: &str, bytes: &[u8]) -> Result<Soup, Error> {
    let mut reader = Reader {
        file,
        lines: Lines::new(file, bytes)?,
        flat: Scope { name: "the file".to_owned(), ..Scope::default() },
        parts: Vec::new(),
        instances: Vec::new(),
        place: Section::File,
        data: Data::Ignored,
        pending: Vec::new(),
        skipped: Vec::new(),
    };
    reader.lines()?;
    reader.soup()
}

impl Reader<'_> {
    fn lines(&mut self) -> Result<(), Error> {
        while let Some(line) = self.lines.next() {
            if line.is_empty() || line.starts_with("**") {
                continue;
            }
            if !line.starts_with('*') {
                self.data(line)?;
                continue;
            }
            if let Some(expected) = self.unfinished() {
                return Err(self.lines.fault(line, expected));
            }
            let mut keyword = line.to_owned();
            while keyword.ends_with(',') {
                let Some(next) = self.lines.next() else { break };
                keyword.push_str(next);
            }
            self.keyword(&keyword)?;
        }
        if let Some(expected) = self.unfinished() {
            return Err(self.lines.ends(expected));
        }
        match self.place {
            Section::File if self.lines.number == 0 => Err(self.lines.ends("`*Node`")),
            Section::File => Ok(()),
            Section::Part => Err(self.lines.ends("`*End Part`")),
            Section::Instance => Err(self.lines.ends("`*End Instance`")),
        }
    }

    fn keyword(&mut self, line: &str) -> Result<(), Error> {
        // name and parameters of the keyword; case and spaces have no meaning in a deck
        let mut fields = line[1..].split(',').map(str::trim);
        let name = fields.next().unwrap_or_default().to_ascii_uppercase();
        let name = name.split_ascii_whitespace().collect::<Vec<_>>().join(" ");
        let parameters: Vec<(String, &str)> = fields
            .map(|field| field.split_once('=').unwrap_or((field, "")))
            .map(|(key, value)| (key.trim().to_ascii_uppercase(), value.trim().trim_matches('"')))
            .collect();
        let value = |key: &str| parameters.iter().find(|(k, _)| k == key).map(|(_, value)| *value);

        // the lines that follow are ignored unless the keyword is one that is read
        let number = self.lines.number;
        self.data = Data::Ignored;
        self.pending.clear();

        // blocks of nodes, elements, parts and instances; what would move or add nodes is refused
        match name.as_str() {
            "NODE" | "ELEMENT" if value("INPUT").is_some() => {
                return Err(
                    self.refused(&format!("*{name}, INPUT="), "paste the file in its place")
                );
            }
            "NODE" => {
                let rectangular =
                    |system: &str| system.is_empty() || system.starts_with(['R', 'r']);
                if !value("SYSTEM").is_none_or(rectangular) {
                    return Err(self
                        .refused("*NODE, SYSTEM=", "write the nodes in rectangular coordinates"));
                }
                self.data = Data::Nodes;
            }
            "ELEMENT" => {
                let kind = value("TYPE").filter(|kind| !kind.is_empty());
                let kind = kind.ok_or_else(|| self.lines.fault(line, "`*Element, type=…`"))?;
                let kind = kind.to_ascii_uppercase();
                let role = match element(&kind) {
                    Element::Face { nodes, corners } => {
                        self.data = Data::Elements { nodes, corners };
                        return Ok(());
                    }
                    Element::Thick => Role::Thick,
                    Element::NoFace => Role::NoSurface,
                    Element::Unknown => Role::Unknown,
                };
                self.data = Data::Skipped(self.skipped_type(kind, role));
            }
            "PART" | "INSTANCE" if self.place != Section::File => {
                let end =
                    if self.place == Section::Part { "`*End Part`" } else { "`*End Instance`" };
                return Err(self.lines.fault(line, end));
            }
            "PART" => {
                let part =
                    value("NAME").ok_or_else(|| self.lines.fault(line, "`*Part, name=…`"))?;
                let name = format!("part `{part}`");
                self.parts.push(Scope { name, ..Scope::default() });
                self.place = Section::Part;
            }
            "INSTANCE" => {
                let missing = || self.lines.fault(line, "`*Instance, name=…, part=…`");
                let name = value("NAME").ok_or_else(missing)?;
                let part = value("PART").map(|part| self.part(part)).transpose()?;
                let own = Scope { name: format!("instance `{name}`"), ..Scope::default() };
                self.instances.push(Instance { part, own, placing: Placing::default() });
                self.place = Section::Instance;
                self.data = Data::Placing { lines: 0 };
            }
            "END PART" if self.place == Section::Part => self.place = Section::File,
            "END INSTANCE" if self.place == Section::Instance => self.place = Section::File,
            "END PART" => return Err(self.lines.fault(line, "`*Part` before it")),
            "END INSTANCE" => return Err(self.lines.fault(line, "`*Instance` before it")),
            _ => {
                if let Some((_, remedy)) = REFUSED.iter().find(|(refused, _)| *refused == name) {
                    let message = format!("*{name} is not read");
                    return Err(refused(self.file, number, message, *remedy));
                }
            }
        }
        Ok(())
    }

    /// The number of a type of elements that are left out.
    fn skipped_type(&mut self, kind: String, role: Role) -> usize {
        let known = self.skipped.iter().position(|skipped| skipped.kind == kind);
        known.unwrap_or_else(|| {
            self.skipped.push(Skipped { kind, role, count: 0, beside: 0, place: None });
            self.skipped.len() - 1
        })
    }

    /// Counts an element that is left out, and keeps its nodes if it may be part of the surface.
    fn skip(&mut self, kind: usize, line: &str) {
        let skipped = &mut self.skipped[kind];
        if skipped.role == Role::NoSurface {
            // an element that goes on in the next line counts where it ends
            skipped.count += usize::from(!line.ends_with(','));
            return;
        }
        self.pending.extend(line.split(',').filter_map(|field| field.trim().parse::<u64>().ok()));
        if !line.ends_with(',') && !self.pending.is_empty() {
            skipped.count += 1;
            let nodes = self.pending.split_off(1);
            self.pending.clear();
            self.scope().lost.push((kind, nodes));
        }
    }

    fn refused(&self, keyword: &str, remedy: &str) -> Error {
        refused(self.file, self.lines.number, format!("{keyword} is not read"), remedy)
    }

    fn part(&self, part: &str) -> Result<usize, Error> {
        let names = || self.parts.iter().map(|scope| scope.name.trim_start_matches("part "));
        let quoted = format!("`{part}`");
        names().position(|name| name.eq_ignore_ascii_case(&quoted)).ok_or_else(|| {
            let known = names().collect::<Vec<_>>().join(", ");
            let known = if known.is_empty() { "none" } else { &known };
            let message = format!("there is no part `{part}`");
            refused(self.file, self.lines.number, message, format!("parts are {known}"))
        })
    }

    /// Where nodes and elements go at this place of the file.
    fn scope(&mut self) -> &mut Scope {
        match (self.place, self.parts.last_mut(), self.instances.last_mut()) {
            (Section::Part, Some(part), _) => part,
            (Section::Instance, _, Some(instance)) => &mut instance.own,
            _ => &mut self.flat,
        }
    }

    fn data(&mut self, line: &str) -> Result<(), Error> {
        match self.data {
            Data::Ignored => Ok(()),
            Data::Skipped(kind) => {
                self.skip(kind, line);
                Ok(())
            }
            Data::Nodes => self.node(line),
            Data::Elements { nodes, corners } => {
                let more = line.ends_with(',');
                let fields = line.split(',').map(str::trim);
                for field in fields.filter(|field| !field.is_empty()) {
                    let number = field.parse().ok().filter(|n| *n > 0);
                    let number =
                        number.ok_or_else(|| self.lines.fault(field, "the number of a node"))?;
                    self.pending.push(number);
                }
                if self.pending.len() > nodes + 1 || (self.pending.len() <= nodes && !more) {
                    return Err(self.lines.fault(line, element_line(nodes)));
                }
                if self.pending.len() == nodes + 1 {
                    let mut element = SurfaceElement {
                        number: self.pending[0],
                        line: self.lines.number,
                        corners: [0; 4],
                        count: corners,
                    };
                    element.corners[..corners].copy_from_slice(&self.pending[1..=corners]);
                    self.pending.clear();
                    self.scope().elements.push(element);
                }
                Ok(())
            }
            Data::Placing { lines } => {
                let mut fields: Vec<&str> = line.split(',').map(str::trim).collect();
                // a comma may end the line
                if matches!(fields[..], [.., ""]) && matches!(fields.len(), 4 | 8) {
                    fields.pop();
                }
                let values = fields.into_iter().map(|field| match field {
                    "" => Ok(0.0),
                    field => self.lines.number(field),
                });
                let values = values.collect::<Result<Vec<_>, _>>()?;
                let instance = self.instances.last_mut();
                let Some(placing) = instance.map(|instance| &mut instance.placing) else {
                    return Ok(());
                };
                if !placing.line(lines, &values) {
                    return Err(self.lines.fault(line, Placing::EXPECTED[lines.min(2)]));
                }
                self.data = Data::Placing { lines: lines + 1 };
                Ok(())
            }
        }
    }

    fn node(&mut self, line: &str) -> Result<(), Error> {
        let expected = "a node: `number, x, y, z`";
        let mut fields = line.split(',').map(str::trim);
        let number = fields.next().and_then(|field| field.parse().ok()).filter(|n| *n > 0);
        let node: u64 = number.ok_or_else(|| self.lines.fault(line, expected))?;
        let mut point = [0.0; 3];
        for coordinate in &mut point {
            let field = fields.next().filter(|field| !field.is_empty());
            *coordinate =
                self.lines.number(field.ok_or_else(|| self.lines.fault(line, expected))?)?;
        }
        let now = self.lines.number;
        match self.scope().nodes.insert(node, (point, now)) {
            Some((other, before)) if other != point => {
                let message = format!(
                    "node {node} is defined again at another place; it is in line {before} already"
                );
                Err(refused(self.file, now, message, "give it a number of its own"))
            }
            _ => Ok(()),
        }
    }

    /// What an element that goes on in the next line still needs.
    fn unfinished(&self) -> Option<String> {
        match self.data {
            Data::Elements { nodes, .. } if !self.pending.is_empty() => Some(element_line(nodes)),
            _ => None,
        }
    }

    /// All elements in their places.
    fn soup(self) -> Result<Soup, Error> {
        let mut soup = Soup::new("element");
        let Reader { file, flat, parts, instances, skipped, .. } = self;
        soup.skipped = skipped;
        // an instance is a line, and all elements of its part once more
        let triangles = |scope: &Scope| -> f64 {
            scope.elements.iter().map(|element| element.count as f64 - 2.0).sum()
        };
        let of_parts: Vec<f64> = parts.iter().map(triangles).collect();
        let mut all = triangles(&flat);
        for instance in &instances {
            all += instance.part.map_or(0.0, |part| of_parts[part]) + triangles(&instance.own);
        }
        size::mesh(all).map_err(|error| error.of_file(file))?;
        add(&mut soup, file, &flat, &Placing::default())?;
        for instance in &instances {
            if let Some(part) = instance.part {
                add(&mut soup, file, &parts[part], &instance.placing)?;
            }
            add(&mut soup, file, &instance.own, &instance.placing)?;
        }
        if instances.is_empty() {
            for part in &parts {
                add(&mut soup, file, part, &Placing::default())?;
            }
        }
        Ok(soup)
    }
}

fn element_line(nodes: usize) -> String {
    format!("an element: its number and {nodes} nodes")
}

/// Adds the elements of a scope in their place.
fn add(soup: &mut Soup, file: &str, scope: &Scope, placing: &Placing) -> Result<(), Error> {
    // nodes that elements use become points, each of them once
    let mut indices: HashMap<u64, u32> = HashMap::with_capacity(scope.nodes.len());
    for element in &scope.elements {
        let mut corners = [0; 4];
        for (corner, node) in corners.iter_mut().zip(&element.corners[..element.count]) {
            *corner = match indices.get(node) {
                Some(index) => *index,
                None => {
                    let (point, _) = scope.nodes.get(node).ok_or_else(|| {
                        let SurfaceElement { number, line, .. } = element;
                        let message = format!(
                            "element {number} uses node {node}, which {} does not define",
                            scope.name
                        );
                        refused(file, *line, message, CORRECT)
                    })?;
                    let index = soup.points.len() as u32;
                    soup.points.push(turned(*point, placing));
                    indices.insert(*node, index);
                    index
                }
            };
        }
        soup.push(&corners[..element.count], element.number);
    }

    // note which elements that were left out lie beside the surface
    if !scope.lost.is_empty() {
        note_lost(&mut soup.skipped, scope, placing);
    }
    Ok(())
}

/// Notes which of the elements that are left out of a scope share an edge with its surface, and where the first one is.
fn note_lost(skipped: &mut [Skipped], scope: &Scope, placing: &Placing) {
    let mut edges: HashSet<[u64; 2]> = HashSet::with_capacity(2 * scope.elements.len());
    for element in &scope.elements {
        let corners = &element.corners[..element.count];
        for (n, &a) in corners.iter().enumerate() {
            let b = corners[(n + 1) % corners.len()];
            edges.insert([a.min(b), a.max(b)]);
        }
    }
    for (kind, nodes) in &scope.lost {
        let skipped = &mut skipped[*kind];
        let is_beside = nodes
            .iter()
            .enumerate()
            .any(|(n, &a)| nodes[..n].iter().any(|&b| edges.contains(&[a.min(b), a.max(b)])));
        let places: Vec<[f64; 3]> =
            nodes.iter().filter_map(|node| Some(scope.nodes.get(node)?.0)).collect();
        if (skipped.place.is_none() || (is_beside && skipped.beside == 0)) && !places.is_empty() {
            let middle =
                [0, 1, 2].map(|c| places.iter().map(|p| p[c]).sum::<f64>() / places.len() as f64);
            skipped.place = Some(turned(middle, placing));
        }
        skipped.beside += usize::from(is_beside);
    }
}
