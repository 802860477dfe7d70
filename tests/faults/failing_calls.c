/* Preloaded into the program: the n-th call of the system that changes or opens something in one folder fails.
 *
 * FAULT_FOLDER  the folder; FAULT_AT the number of the call, from 1; FAULT_ERRNO what it fails with;
 * FAULT_FOREVER all calls from that one on; FAULT_LOG a file outside the folder that gets one line a call made to fail: number, name and path.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static int inside(const char *path) {
    const char *folder = getenv("FAULT_FOLDER");
    return folder && path && strncmp(path, folder, strlen(folder)) == 0;
}

static const char *path_of(int fd) {
    static char path[PATH_MAX];
    char link[64];
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    ssize_t n = readlink(link, path, sizeof path - 1);
    path[n < 0 ? 0 : n] = 0;
    return path;
}

static int fails(const char *path, const char *name) {
    if (!inside(path)) return 0;
    static int at, calls;
    if (at != atoi(getenv("FAULT_AT"))) at = atoi(getenv("FAULT_AT")), calls = 0; /* the next run of one process */
    int n = ++calls;
    if (n != at && !(n > at && getenv("FAULT_FOREVER"))) return 0;
    int log = syscall(SYS_openat, AT_FDCWD, getenv("FAULT_LOG"), O_WRONLY | O_CREAT | O_APPEND, 0666);
    if (log >= 0) {
        char line[PATH_MAX + 64];
        int length = snprintf(line, sizeof line, "%d %s %s\n", n, name, path);
        if (syscall(SYS_write, log, line, length) < 0) abort();
        syscall(SYS_close, log);
    }
    errno = atoi(getenv("FAULT_ERRNO"));
    return 1;
}

#define REAL(type, name, ...) ((type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, #name))

#define OPEN(name)                                                                         \
    int name(const char *path, int flags, ...) {                                           \
        va_list more;                                                                      \
        va_start(more, flags);                                                             \
        int mode = va_arg(more, int);                                                      \
        va_end(more);                                                                      \
        return fails(path, #name) ? -1 : REAL(int, name, const char *, int, ...)(path, flags, mode); \
    }
OPEN(open)
OPEN(open64)

#define HANDLE(type, name, rest, ...)                                                      \
    type name(int fd __VA_OPT__(, ) __VA_ARGS__) {                                         \
        return fails(path_of(fd), #name) ? -1 : CALL_##name;                         \
    }
#define CALL_write REAL(ssize_t, write, int, const void *, size_t)(fd, data, size)
HANDLE(ssize_t, write, 0, const void *data, size_t size)
#define CALL_fsync REAL(int, fsync, int)(fd)
HANDLE(int, fsync, 0)
#define CALL_fchmod REAL(int, fchmod, int, mode_t)(fd, mode)
HANDLE(int, fchmod, 0, mode_t mode)
#define CALL_fchown REAL(int, fchown, int, uid_t, gid_t)(fd, owner, group)
HANDLE(int, fchown, 0, uid_t owner, gid_t group)

#define PAIR(name)                                                                         \
    int name(const char *a, const char *b) {                                               \
        return fails(inside(a) ? a : b, #name) ? -1 : REAL(int, name, const char *, const char *)(a, b); \
    }
PAIR(rename)
PAIR(link)
PAIR(symlink)

#define ONE(name)                                                                          \
    int name(const char *path) {                                                           \
        return fails(path, #name) ? -1 : REAL(int, name, const char *)(path);      \
    }
ONE(unlink)
ONE(rmdir)

#define LOOK(name)                                                                         \
    int name(const char *path, struct stat64 *found) {                                     \
        return fails(path, #name) ? -1 : REAL(int, name, const char *, struct stat64 *)(path, found); \
    }
LOOK(stat64)
LOOK(lstat64)
#define CALL_fstat64 REAL(int, fstat64, int, struct stat64 *)(fd, found)
HANDLE(int, fstat64, 0, struct stat64 *found)

int chmod(const char *path, mode_t mode) {
    return fails(path, "chmod") ? -1 : REAL(int, chmod, const char *, mode_t)(path, mode);
}
int mkdir(const char *path, mode_t mode) {
    return fails(path, "mkdir") ? -1 : REAL(int, mkdir, const char *, mode_t)(path, mode);
}
