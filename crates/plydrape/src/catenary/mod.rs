//! catenary
