//! A writer that keeps its first fault for later, because the archive's writer prints what fails while it is dropped.

use std::io::{self, Seek, SeekFrom, Write};

/// Writes through until the first fault, and from then on only counts.
#[derive(Debug)]
pub struct Latch<W> {
    to: W,
    place: u64,
    end: u64,
    fault: Option<io::Error>,
}

impl<W: Write + Seek> Latch<W> {
    /// At the beginning of an empty file.
    pub fn new(to: W) -> Self {
        Latch { to, place: 0, end: 0, fault: None }
    }

    /// The first fault, if there was one; else everything is written.
    pub fn done(mut self) -> io::Result<()> {
        match self.fault.take() {
            Some(fault) => Err(fault),
            None => self.to.flush(),
        }
    }

    fn keep<T>(&mut self, result: io::Result<T>) {
        if let Err(fault) = result {
            self.fault.get_or_insert(fault);
        }
    }
}

impl<W: Write + Seek> Write for Latch<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.fault.is_none() {
            let result = self.to.write_all(bytes);
            self.keep(result);
        }
        self.place += bytes.len() as u64;
        self.end = self.end.max(self.place);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.fault.is_none() {
            let result = self.to.flush();
            self.keep(result);
        }
        Ok(())
    }
}

impl<W: Write + Seek> Seek for Latch<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let place = match to {
            SeekFrom::Start(place) => Some(place),
            SeekFrom::Current(way) => self.place.checked_add_signed(way),
            SeekFrom::End(way) => self.end.checked_add_signed(way),
        };
        self.place = place.ok_or(io::ErrorKind::InvalidInput)?;
        if self.fault.is_none() {
            let result = self.to.seek(SeekFrom::Start(self.place));
            self.keep(result);
        }
        Ok(self.place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    /// A file that takes so many bytes only.
    struct Full(Cursor<Vec<u8>>, usize);

    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            match self.0.get_ref().len() + bytes.len() > self.1 {
                true => Err(io::ErrorKind::StorageFull.into()),
                false => self.0.write(bytes),
            }
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl Seek for Full {
        fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
            self.0.seek(to)
        }
    }

    /// An archive on a disk that becomes full anywhere is written to its end without a panic, and the fault is found then.
    #[test]
    fn a_full_disk_is_found_at_the_end() {
        for size in [0, 10, 45, 100, 1000] {
            let mut archive = zip::ZipWriter::new(Latch::new(Full(Cursor::default(), size)));
            for name in ["a", "b"] {
                archive.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
                archive.write_all(&[7; 40]).unwrap();
            }
            let done = archive.finish().unwrap().done();
            assert_eq!(done.is_ok(), size == 1000, "{size}");
        }
    }
}
