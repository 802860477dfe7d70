/* Preloaded into the program: the n-th call of the system that changes or opens something in one folder fails.
 *
 * FAULT_FOLDER  the folder; FAULT_AT the number of the call, from 1; FAULT_ERRNO what it fails with;
 * FAULT_FOREVER all calls from that one on; FAULT_LOG a file outside the folder that gets one line a call made to fail.
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

static int calls;

static int inside(const char *path) {
    const char *folder = getenv("FAULT_FOLDER");
    return folder && path && strncmp(path, folder, strlen(folder)) == 0;
}

static int inside_handle(int fd) {
    char link[64], path[PATH_MAX];
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    ssize_t n = readlink(link, path, sizeof path - 1);
    if (n < 0) return 0;
    path[n] = 0;
    return inside(path);
}

static int fails(int counts, const char *name) {
    if (!counts) return 0;
    int at = atoi(getenv("FAULT_AT")), n = ++calls;
    if (n != at && !(n > at && getenv("FAULT_FOREVER"))) return 0;
    int log = syscall(SYS_openat, AT_FDCWD, getenv("FAULT_LOG"), O_WRONLY | O_CREAT | O_APPEND, 0666);
    if (log >= 0) {
        char line[64];
        int length = snprintf(line, sizeof line, "%d %s\n", n, name);
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
        return fails(inside(path), #name) ? -1 : REAL(int, name, const char *, int, ...)(path, flags, mode); \
    }
OPEN(open)
OPEN(open64)

#define HANDLE(type, name, rest, ...)                                                      \
    type name(int fd __VA_OPT__(, ) __VA_ARGS__) {                                         \
        return fails(inside_handle(fd), #name) ? -1 : CALL_##name;                         \
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
        return fails(inside(a) || inside(b), #name) ? -1 : REAL(int, name, const char *, const char *)(a, b); \
    }
PAIR(rename)
PAIR(link)
PAIR(symlink)

#define ONE(name)                                                                          \
    int name(const char *path) {                                                           \
        return fails(inside(path), #name) ? -1 : REAL(int, name, const char *)(path);      \
    }
ONE(unlink)
ONE(rmdir)

#define LOOK(name)                                                                         \
    int name(const char *path, struct stat64 *found) {                                     \
        return fails(inside(path), #name) ? -1 : REAL(int, name, const char *, struct stat64 *)(path, found); \
    }
LOOK(stat64)
LOOK(lstat64)
#define CALL_fstat64 REAL(int, fstat64, int, struct stat64 *)(fd, found)
HANDLE(int, fstat64, 0, struct stat64 *found)

int chmod(const char *path, mode_t mode) {
    return fails(inside(path), "chmod") ? -1 : REAL(int, chmod, const char *, mode_t)(path, mode);
}
int mkdir(const char *path, mode_t mode) {
    return fails(inside(path), "mkdir") ? -1 : REAL(int, mkdir, const char *, mode_t)(path, mode);
}
