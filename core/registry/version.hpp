// Pfaff's version number. The build reads it from here.
#pragma once

#define PFAFF_VERSION_TEXT "0.1.0"
