//! The bag: an MCAP file of the `ros2` profile, as `rosbag2` writes it.
//!
//! Times in it count from the start of the drape, so that the same result gives the same bytes.

use super::{cdr, schema};
use crate::Error;
use mcap::records::{MessageHeader, Metadata};
use mcap::{McapError, WriteOptions, Writer};
use serde::Serialize;
use std::collections::BTreeMap;
use std::io::Cursor;

/// Durability of a topic whose last message is kept for who comes later, and of one whose is not.
const TRANSIENT_LOCAL: u8 = 1;
pub(super) const VOLATILE: u8 = 2;

/// A bag under way.
pub(super) struct Bag {
    writer: Writer<Cursor<Vec<u8>>>,
    channels: BTreeMap<&'static str, Channel>,
    /// The messages, until all of them can be written in the order of time.
    messages: Vec<(MessageHeader, Vec<u8>)>,
}

struct Channel {
    id: u16,
    messages: u32,
}

/// A bag that could not be made.
fn unmade(fault: McapError) -> Error {
    Error::Internal(format!("cannot make the bag: {fault}"))
}

impl Bag {
    /// An empty bag.
    pub fn new() -> Result<Self, Error> {
        let options = WriteOptions::new().profile("ros2").library(crate::PROGRAM).compression(None);
        let writer = options.create(Cursor::new(Vec::new())).map_err(unmade)?;
        Ok(Bag { writer, channels: BTreeMap::new(), messages: Vec::new() })
    }

    /// Adds a topic of messages of a full name, and of a durability.
    pub fn channel(
        &mut self,
        topic: &'static str,
        message: &str,
        durability: u8,
    ) -> Result<(), Error> {
        let text = schema::text(message);
        let known = self.writer.add_schema(message, "ros2msg", text.as_bytes()).map_err(unmade)?;
        let offered = [("offered_qos_profiles".to_owned(), quality(durability))];
        let id = self.writer.add_channel(known, topic, "cdr", &offered.into()).map_err(unmade)?;
        self.channels.insert(topic, Channel { id, messages: 0 });
        Ok(())
    }

    /// Adds a topic and its one message, at the start, which late subscribers get too.
    pub fn latched<T: Serialize>(
        &mut self,
        topic: &'static str,
        name: &str,
        message: &T,
    ) -> Result<(), Error> {
        self.channel(topic, name, TRANSIENT_LOCAL)?;
        self.write(topic, 0, message)
    }

    /// Adds a message to a topic at a time (ns).
    pub fn write<T: Serialize>(
        &mut self,
        topic: &'static str,
        time: u64,
        message: &T,
    ) -> Result<(), Error> {
        let channel = self.channels.get_mut(topic);
        let channel =
            channel.ok_or_else(|| Error::Internal(format!("the bag has no topic {topic}")))?;
        let header = MessageHeader {
            channel_id: channel.id,
            sequence: channel.messages,
            log_time: time,
            publish_time: time,
        };
        channel.messages += 1;
        self.messages.push((header, cdr::bytes(message)?));
        Ok(())
    }

    /// Adds a record of names and values.
    pub fn note<const N: usize>(
        &mut self,
        name: &str,
        values: [(&str, String); N],
    ) -> Result<(), Error> {
        let metadata = values.map(|(name, value)| (name.to_owned(), value)).into();
        self.writer.write_metadata(&Metadata { name: name.to_owned(), metadata }).map_err(unmade)
    }

    /// The whole file.
    pub fn finish(mut self) -> Result<Vec<u8>, Error> {
        self.messages.sort_by_key(|(header, _)| header.log_time);
        for (header, bytes) in &self.messages {
            self.writer.write_to_known_channel(header, bytes).map_err(unmade)?;
        }
        self.writer.finish().map_err(unmade)?;
        Ok(self.writer.into_inner().into_inner())
    }
}

/// How a publisher offers a topic, in the words of `rosbag2`: reliable, the last message kept, no deadline.
///
/// Numbers are those of `rmw`, which every version of `rosbag2` reads.
fn quality(durability: u8) -> String {
    let forever = "\n    sec: 9223372036\n    nsec: 854775807";
    format!(
        "- history: 1\n  depth: 1\n  reliability: 1\n  durability: {durability}\n  \
         deadline:{forever}\n  lifespan:{forever}\n  liveliness: 1\n  \
         liveliness_lease_duration:{forever}\n  avoid_ros_namespace_conventions: false\n"
    )
}
