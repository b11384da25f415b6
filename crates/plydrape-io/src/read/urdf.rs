//! Arms of robots in the Unified Robot Description Format: their joints, and the bodies of their links.
//!
//! Of a robot the links between a foot and a flange are read, with what is fixed to them. XML is read by the crate `roxmltree`, which
//! follows no reference to another file and bounds its entities.

use crate::Error;
use crate::store::shown;
use plydrape::arm::{JOINTS, Joint};
use plydrape::geometry::Pose;
use plydrape::geometry::vector::unit;
use roxmltree::{Document, Node};
use std::collections::{BTreeMap, BTreeSet};

/// The largest file that is read (bytes).
pub const LARGEST: u64 = 4 << 20;
/// Letters of a name at most.
const LONGEST_NAME: usize = 80;
/// The largest number that a robot has (m, rad).
const FARTHEST: f64 = 1e4;
/// The range of a joint that turns without end (rad).
const ENDLESS: f64 = 1e3;

/// The arm of a robot.
#[derive(Debug)]
pub struct Urdf {
    /// Name.
    pub name: String,
    /// The turning joints from foot to flange.
    pub joints: [Joint; JOINTS],
    /// Where the flange is in the frame of the last one.
    pub flange: Pose,
    /// Shapes of links: which joint carries each, from 1, or 0 of the foot.
    pub bodies: Vec<UrdfBody>,
}

/// A shape of a link.
#[derive(Debug)]
pub struct UrdfBody {
    /// The link's name.
    pub name: String,
    /// The joint that carries it, from 1, or 0 of the foot.
    pub link: usize,
    /// Where the shape is in that joint's frame.
    pub pose: Pose,
    /// The shape.
    pub shape: UrdfShape,
}

/// A shape in its own coordinates (m).
#[derive(Debug)]
pub enum UrdfShape {
    /// A cylinder about z, with its middle in the origin.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Length.
        length: f64,
    },
    /// A box with its middle in the origin.
    Box([f64; 3]),
    /// A mesh file, by the name that the robot has for it, and the scale of its coordinates.
    Mesh(String, [f64; 3]),
}

/// A joint of any kind.
struct AnyJoint<'a, 'i> {
    node: Node<'a, 'i>,
    name: &'a str,
    kind: &'a str,
    parent: &'a str,
    origin: Pose,
}

/// The file under reading.
struct Reader<'a, 'i> {
    file: &'a str,
    document: &'a Document<'i>,
    /// The joint that carries each link.
    carried: BTreeMap<&'a str, AnyJoint<'a, 'i>>,
}

/// Reads the arm between two links of a robot, by their names: its foot is the link `base` unless another is named, or the link that no joint
/// carries; its flange is `tool0`, or the one link that carries nothing.
///
/// # Errors
/// [`Error::File`] where the text is no such robot.
pub fn parse(
    file: &str,
    text: &str,
    foot: Option<&str>,
    flange: Option<&str>,
) -> Result<Urdf, Error> {
    // the text must be XML that describes a robot
    let document = Document::parse(text).map_err(|error| {
        Error::file(
            file,
            format!("{file} is no XML: {error}"),
            "export the robot as URDF again; of a .xacro file, run `xacro` first",
        )
    })?;
    let robot = document.root_element();
    if robot.tag_name().name() != "robot" {
        let message =
            format!("{file} begins with <{}> and not with <robot>", robot.tag_name().name());
        return Err(Error::file(file, message, "name a URDF file, which describes a robot"));
    }

    // names go into programs of robots, which is why they may hold plain characters only
    for node in robot.descendants().filter(|node| {
        node.has_tag_name("joint") || node.has_tag_name("link") || node.has_tag_name("robot")
    }) {
        if let Some(name) = node.attribute("name").filter(|name| !is_plain(name)) {
            let line = document.text_pos_at(node.range().start).row;
            let message = format!(
                "{file}, line {line}: the name \"{}\" has other characters than letters, digits and . _ - /",
                shown::escaped(&shown::excerpt(name, 40))
            );
            return Err(Error::file(
                file,
                message,
                "rename it: names of joints go into programs of robots",
            ));
        }
    }

    // joints by the link that they carry; each link is carried by one joint at most
    let mut reader = Reader { file, document: &document, carried: BTreeMap::new() };
    let mut names = BTreeSet::new();
    for node in children(robot, "joint") {
        let joint = reader.any_joint(node)?;
        let child = reader.link_of(node, "child")?;
        if !names.insert(joint.name) {
            let message = format!("two joints have the name {}", joint.name);
            return Err(reader.fault(node, message, "give each a name of its own"));
        }
        if reader.carried.insert(child, joint).is_some() {
            return Err(reader.fault(
                node,
                format!("two joints carry the link {child}"),
                "let one joint carry each link",
            ));
        }
    }

    // links that the scene names must exist
    let links: Vec<&str> =
        children(robot, "link").filter_map(|link| link.attribute("name")).collect();
    let known = |name: &str| links.contains(&name);
    for name in [foot, flange].into_iter().flatten() {
        if !known(name) {
            return Err(Error::file(
                file,
                format!("{file} has no link {name}"),
                format!("it has {}", links.join(", ")),
            ));
        }
    }

    // unless it is named, the foot is the link `base`, or one that nothing carries
    let root = links.iter().copied().find(|link| !reader.carried.contains_key(link));
    let foot = foot.or(Some("base").filter(|name| known(name))).or(root);

    // unless it is named, the flange is the link `tool0`, or the only one that carries nothing
    let parents: BTreeSet<&str> = reader.carried.values().map(|joint| joint.parent).collect();
    let mut ends = links.iter().copied().filter(|link| !parents.contains(link));
    let end = ends.next().filter(|_| ends.next().is_none());
    let flange = flange.or(Some("tool0").filter(|name| known(name))).or(end);

    let (Some(foot), Some(flange)) = (foot, flange) else {
        let message = format!("{file} does not say which of its links is the flange");
        return Err(Error::file(
            file,
            message,
            format!("add flange = \"...\" to [robot]: one of {}", links.join(", ")),
        ));
    };

    reader.arm(robot.attribute("name").unwrap_or("robot"), foot, flange)
}

/// Whether a name has what names of joints have: letters, digits and a few signs, and no more than a line of them.
pub(crate) fn is_plain(name: &str) -> bool {
    let sign = |c: char| c.is_ascii_alphanumeric() || "._-/".contains(c);
    !name.is_empty() && name.len() <= LONGEST_NAME && name.chars().all(sign)
}

fn children<'a, 'i>(node: Node<'a, 'i>, name: &'a str) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(move |child| child.has_tag_name(name))
}

impl<'a, 'i> Reader<'a, 'i> {
    fn fault(&self, node: Node, message: String, help: impl Into<String>) -> Error {
        let line = self.document.text_pos_at(node.range().start).row;
        Error::file(self.file, format!("{}, line {line}: {message}", self.file), help)
    }

    /// The numbers of an attribute, or `usual` ones where the node does not have it.
    fn numbers<const N: usize>(
        &self,
        node: Node,
        name: &str,
        usual: Option<[f64; N]>,
    ) -> Result<[f64; N], Error> {
        let Some(text) = node.attribute(name) else {
            return usual.ok_or_else(|| {
                let tag = node.tag_name().name();
                self.fault(node, format!("<{tag}> has no {name}"), format!("give it {N} numbers"))
            });
        };
        let numbers: Vec<f64> =
            text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        let near = |x: &f64| x.abs() <= FARTHEST;
        let numbers = <[f64; N]>::try_from(numbers).ok().filter(|all| all.iter().all(near));
        numbers.filter(|all| text.split_whitespace().count() == all.len()).ok_or_else(|| {
            let message = format!(
                "{name} = \"{}\" are not {N} numbers of up to {FARTHEST}",
                shown::excerpt(text, 40)
            );
            self.fault(
                node,
                message,
                "a .xacro file has formulas where URDF has numbers: run `xacro` first",
            )
        })
    }

    /// The origin of a joint or a shape.
    fn origin(&self, node: Node) -> Result<Pose, Error> {
        let Some(origin) = children(node, "origin").next() else { return Ok(Pose::ORIGIN) };
        let place = self.numbers(origin, "xyz", Some([0.0; 3]))?;
        Ok(Pose::new(place, self.numbers(origin, "rpy", Some([0.0; 3]))?))
    }

    fn link_of(&self, node: Node<'a, 'i>, tag: &'a str) -> Result<&'a str, Error> {
        let link = children(node, tag).next().and_then(|link| link.attribute("link"));
        link.ok_or_else(|| {
            self.fault(node, format!("this joint has no {tag}"), "name the links that it joins")
        })
    }

    fn any_joint(&self, node: Node<'a, 'i>) -> Result<AnyJoint<'a, 'i>, Error> {
        Ok(AnyJoint {
            node,
            name: node.attribute("name").unwrap_or("joint"),
            kind: node.attribute("type").unwrap_or(""),
            parent: self.link_of(node, "parent")?,
            origin: self.origin(node)?,
        })
    }

    /// The links that carry a link one after another, itself first, and where it is in each; no farther than `end`.
    fn chain(&self, link: &'a str, end: &str) -> Result<Vec<(&'a str, Pose)>, Error> {
        let mut chain = vec![(link, Pose::ORIGIN)];
        let (mut now, mut pose) = (link, Pose::ORIGIN);
        while let Some(joint) = self.carried.get(now).filter(|_| now != end) {
            pose = joint.origin.compose(&pose);
            now = joint.parent;
            if chain.len() > self.carried.len() {
                return Err(self.fault(
                    joint.node,
                    "the links carry each other in a circle".into(),
                    "let one link carry all",
                ));
            }
            chain.push((now, pose));
        }
        Ok(chain)
    }

    fn arm(&self, name: &str, foot: &'a str, flange: &'a str) -> Result<Urdf, Error> {
        // up from the flange, and from the foot, whose frame may itself be fixed to the first link
        let mut up: Vec<_> = self.chain(flange, foot)?.into_iter().map(|(link, _)| link).collect();
        let mut before = Pose::ORIGIN;
        if up.last() != Some(&foot) {
            let from_foot = self.chain(foot, "")?;
            let met: BTreeSet<&str> = up.iter().copied().collect();
            let common = from_foot.iter().find(|(link, _)| met.contains(link));
            let Some((common, pose)) = common else {
                let message =
                    format!("{} joins the links {foot} and {flange} by no joints", self.file);
                return Err(Error::file(
                    self.file,
                    message,
                    "name the links at the foot and at the flange of one arm",
                ));
            };
            up.truncate(up.iter().position(|link| link == common).map_or(0, |n| n + 1));
            before = pose.inverse();
        }
        let mut joints: Vec<Joint> = Vec::new();
        // the frame of a link in that of the turning joint before it
        let mut frames: BTreeMap<&'a str, (usize, Pose)> = BTreeMap::new();
        if let Some(first) = up.last() {
            frames.insert(*first, (0, before));
        }
        for link in up.iter().rev().skip(1) {
            let Some(joint) = self.carried.get(link) else { continue };
            let pose = before.compose(&joint.origin);
            before = match joint.kind {
                "fixed" => pose,
                "revolute" | "continuous" => {
                    joints.push(self.turning(joint, pose)?);
                    Pose::ORIGIN
                }
                other => {
                    let message = format!(
                        "the joint {} is {other}: arms of turning joints are known",
                        joint.name
                    );
                    return Err(self.fault(joint.node, message, "name the links at the foot and at the flange of an arm of six turning joints"));
                }
            };
            frames.insert(*link, (joints.len(), before));
        }
        let count = joints.len();
        let joints = <[Joint; JOINTS]>::try_from(joints).map_err(|_| {
            let message = format!("{} has {count} turning joints from {foot} to {flange}, and arms of {JOINTS} are known", self.file);
            Error::file(self.file, message, "name the links at the foot and at the flange of an arm of six turning joints")
        })?;
        Ok(Urdf { name: name.into(), joints, flange: before, bodies: self.bodies(frames)? })
    }

    fn turning(&self, joint: &AnyJoint, pose: Pose) -> Result<Joint, Error> {
        // the axis of the joint, in URDF x unless given
        let axis = match children(joint.node, "axis").next() {
            Some(axis) => self.numbers(axis, "xyz", None)?,
            None => [1.0, 0.0, 0.0],
        };
        let axis = unit(axis).ok_or_else(|| {
            self.fault(
                joint.node,
                "its axis has no direction".into(),
                "give it one, as in xyz=\"0 0 1\"",
            )
        })?;

        // its speed, and the range in which it turns
        let limit = children(joint.node, "limit").next().ok_or_else(|| {
            self.fault(
                joint.node,
                format!("the joint {} has no limits", joint.name),
                "add <limit lower=... upper=... velocity=.../> in rad and rad/s",
            )
        })?;
        let [speed] = self.numbers(limit, "velocity", None)?;
        let range = match joint.kind {
            "continuous" => [-ENDLESS, ENDLESS],
            _ => {
                let ([lower], [upper]) = (
                    self.numbers(limit, "lower", Some([0.0]))?,
                    self.numbers(limit, "upper", Some([0.0]))?,
                );
                [lower, upper]
            }
        };

        // a joint that cannot move is refused
        if !(speed > 0.0 && range[0] < range[1]) {
            let message = format!(
                "the joint {} cannot move: from {} to {} rad with {speed} rad/s",
                joint.name, range[0], range[1]
            );
            return Err(self.fault(limit, message, "give its range and its speed"));
        }
        Ok(Joint { name: joint.name.into(), pose, axis, range, speed })
    }

    /// The shapes of all links that are on the way or fixed to it.
    fn bodies(&self, frames: BTreeMap<&'a str, (usize, Pose)>) -> Result<Vec<UrdfBody>, Error> {
        let mut bodies = Vec::new();
        // links that are seen; `None` of those that are not fixed to the arm
        let mut frames: BTreeMap<&str, _> =
            frames.into_iter().map(|(link, frame)| (link, Some(frame))).collect();
        for node in children(self.document.root_element(), "link") {
            let name = node.attribute("name").unwrap_or("link");
            let (mut now, mut fixed) = (name, Vec::new());
            while !frames.contains_key(now) {
                frames.insert(now, None);
                let Some(joint) = self.carried.get(now).filter(|joint| joint.kind == "fixed")
                else {
                    break;
                };
                fixed.push((now, joint));
                now = joint.parent;
            }
            let mut frame = frames[now];
            for (link, joint) in fixed.into_iter().rev() {
                frame = frame.map(|(index, pose)| (index, pose.compose(&joint.origin)));
                frames.insert(link, frame);
            }
            let Some((link, frame)) = frame else { continue };
            for collision in children(node, "collision") {
                let pose = frame.compose(&self.origin(collision)?);
                let Some(shape) = self.shape(collision)? else { continue };
                bodies.push(UrdfBody { name: name.into(), link, pose, shape });
            }
        }
        Ok(bodies)
    }

    /// Numbers above zero of an attribute.
    fn sizes<const N: usize>(&self, node: Node, name: &str) -> Result<[f64; N], Error> {
        let sizes = self.numbers(node, name, None)?;
        if sizes.iter().all(|size| *size > 0.0) {
            return Ok(sizes);
        }
        let message = format!("{name} = \"{}\" is no size", node.attribute(name).unwrap_or(""));
        Err(self.fault(node, message, "give sizes above zero in meters"))
    }

    fn shape(&self, collision: Node) -> Result<Option<UrdfShape>, Error> {
        let geometry = children(collision, "geometry").next();
        let Some(node) = geometry.and_then(|node| node.children().find(Node::is_element)) else {
            return Ok(None);
        };
        Ok(match node.tag_name().name() {
            "cylinder" => {
                let ([radius], [length]) =
                    (self.sizes(node, "radius")?, self.sizes(node, "length")?);
                Some(UrdfShape::Cylinder { radius, length })
            }
            // with its round ends, which are beyond the length
            "capsule" => {
                let ([radius], [length]) =
                    (self.sizes(node, "radius")?, self.sizes(node, "length")?);
                Some(UrdfShape::Cylinder { radius, length: length + 2.0 * radius })
            }
            // as the cube around it
            "sphere" => {
                let [radius] = self.sizes(node, "radius")?;
                Some(UrdfShape::Box([2.0 * radius; 3]))
            }
            "box" => Some(UrdfShape::Box(self.sizes(node, "size")?)),
            "mesh" => {
                let scale = self.numbers(node, "scale", Some([1.0; 3]))?;
                if scale.contains(&0.0) {
                    let help = "give a scale of each axis, as in scale=\"0.001 0.001 0.001\"";
                    return Err(self.fault(node, "its scale has a zero".into(), help));
                }
                node.attribute("filename").map(|name| UrdfShape::Mesh(name.into(), scale))
            }
            _ => None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A robot with joints of these kinds in a row.
    fn robot(kinds: &[&str]) -> String {
        let mut text = String::from("<robot name=\"r\"><link name=\"base\"/>");
        let mut before = "base".to_string();
        for (n, kind) in kinds.iter().enumerate() {
            text += &format!(
                "<link name=\"l{n}\"><collision><geometry><sphere radius=\"0.1\"/></geometry></collision></link>\
                 <joint name=\"j{n}\" type=\"{kind}\"><origin xyz=\"0 0 0.{n}\"/><parent link=\"{before}\"/><child link=\"l{n}\"/>\
                 <axis xyz=\"0 0 2\"/><limit lower=\"-1\" upper=\"1\" velocity=\"3\"/></joint>"
            );
            before = format!("l{n}");
        }
        text + "</robot>"
    }

    /// What is fixed between two joints is part of the way, and what is fixed behind the last one is the flange's; axes have unit length.
    #[test]
    fn what_is_fixed_is_on_the_way() {
        let kinds = [
            "revolute",
            "fixed",
            "revolute",
            "revolute",
            "revolute",
            "continuous",
            "revolute",
            "fixed",
        ];
        let arm = parse("r.urdf", &robot(&kinds), None, None).unwrap();
        // after the first joint at 0.0 m a fixed one of 0.1 m and the next of 0.2 m
        assert!((arm.joints[1].pose.position[2] - 0.3).abs() < 1e-15);
        assert!((arm.flange.position[2] - 0.7).abs() < 1e-15);
        assert_eq!(arm.joints[0].axis, [0.0, 0.0, 1.0]);
        assert!(arm.joints[4].range[1] > 100.0);
        let links: Vec<usize> = arm.bodies.iter().map(|body| body.link).collect();
        assert_eq!(links, [1, 1, 2, 3, 4, 5, 6, 6]);
    }

    /// A chain of links, each fixed to the one before, and listed from its end: all are bodies of what carries the first one, and none if
    /// that is a loose joint.
    #[test]
    fn a_chain_of_fixed_links_is_carried_by_its_first_joint() {
        for (kind, bodies) in [("floating", 6), ("fixed", 306)] {
            let link = |n: usize| {
                let parent = if n == 0 { "base".into() } else { format!("f{}", n - 1) };
                let kind = if n == 0 { kind } else { "fixed" };
                format!(
                    "<link name=\"f{n}\"><collision><geometry><box size=\"1 1 1\"/></geometry></collision></link>\
                     <joint name=\"f{n}\" type=\"{kind}\"><origin xyz=\"0 0 1\"/><parent link=\"{parent}\"/>\
                     <child link=\"f{n}\"/></joint>"
                )
            };
            let chain: String = (0..300).rev().map(link).collect();
            let text = robot(&["revolute"; 6]).replace("</robot>", &format!("{chain}</robot>"));
            let found = parse("r.urdf", &text, None, Some("l5")).unwrap().bodies;
            assert_eq!(found.len(), bodies);
            let place =
                found.iter().find(|body| body.name == "f299").map(|body| body.pose.position);
            assert_eq!(place, (kind == "fixed").then_some([0.0, 0.0, 300.0]));
        }
    }

    /// What is no arm of six turning joints, or no URDF, is refused with what it is and what to do.
    #[test]
    fn what_is_no_arm_is_refused() {
        let refused = |text: &str| {
            let error = parse("r.urdf", text, None, None).unwrap_err();
            assert!(!error.help().is_empty(), "{error}");
            error.to_string()
        };
        assert!(refused("no XML at all").contains("no XML"));
        assert!(refused("<model/>").contains("<model>"));
        assert!(refused(&robot(&["revolute"; 5])).contains("5 turning joints"));
        let sliding = ["revolute", "prismatic", "revolute", "revolute", "revolute", "revolute"];
        assert!(refused(&robot(&sliding)).contains("prismatic"));
        let formula = robot(&["revolute"; 6]).replace("0 0 0.3", "0 0 ${d}");
        assert!(refused(&formula).contains("line 1"));
        let still = robot(&["revolute"; 6]).replace("velocity=\"3\"", "velocity=\"0\"");
        assert!(refused(&still).contains("cannot move"));
        let round =
            robot(&["revolute"; 6]).replace("<parent link=\"base\"/>", "<parent link=\"l5\"/>");
        assert!(refused(&round).contains("r.urdf"));
        let quoted = robot(&["revolute"; 6]).replace("\"j3\"", "'j3\"/&gt;'");
        assert!(refused(&quoted).contains("other characters"));
        let twice = robot(&["revolute"; 6]).replace("\"j3\"", "\"j2\"");
        assert!(refused(&twice).contains("two joints"));
        let flat = robot(&["revolute"; 6]).replace("radius=\"0.1\"", "radius=\"-0.1\"");
        assert!(refused(&flat).contains("no size"));
        let far = robot(&["revolute"; 6]).replace("0 0 0.3", "0 0 1e300");
        assert!(refused(&far).contains("1e300"));
        // a text that would grow without end
        let bomb = "<!DOCTYPE r [<!ENTITY a \"aa\"><!ENTITY b \"&a;&a;\">]><robot>&b;</robot>";
        assert!(refused(bomb).contains("no XML"));
    }

    /// The foot is the link `base` where there is one, whatever it is fixed to, unless another is named.
    #[test]
    fn links_that_are_fixed_to_a_foot_are_no_joints() {
        let six = robot(&["revolute"; 6]);
        let mounted = six.replace(
            "<link name=\"base\"/>",
            "<link name=\"world\"/><link name=\"base\"/><joint name=\"w\" type=\"fixed\"><origin xyz=\"1 2 3\"/>\
             <parent link=\"world\"/><child link=\"base\"/></joint>",
        );
        let [plain, own, world] = [(&six, None), (&mounted, None), (&mounted, Some("world"))]
            .map(|(text, foot)| parse("r.urdf", text, foot, None).unwrap());
        assert_eq!(plain.joints, own.joints);
        assert_eq!(world.joints[0].pose.position, [1.0, 2.0, 3.0]);
    }
}
